"""The errors of sensors, against what is measured and published of their kind."""

import msgspec
import numpy as np

from nav.messages import LIDAR_COUNT_M, GpsQuality
from scenarios.nqe import build as build_nqe
from scenarios.route.course import SKY
from scenarios.truth.allan import allan_deviation
from scenarios.truth.check import Check, Curve, Floats, Range, within
from scenarios.truth.standing import Standing
from twin.sensors.gps import Gps
from twin.sensors.imu import Imu
from twin.sensors.lidar import Lidar
from twin.sensors.parameters import sensor_parameters
from twin.sensors.sight import Sight
from twin.world import Obstacle, World

P = sensor_parameters()
EXACT = msgspec.structs.replace(P.mounting, position_sd_m=0.0, angle_sd_rad=0.0)
SCANS, RECEIVERS = 400, 1500
LOCKED = 25
"""Fixes after which a receiver has found its first lock."""
MOUTH_M = 3.0
"""Nearer to a mouth, a tunnel leaves some sky."""


class Flat:
    """A level plain at height 0."""

    def height(self, x: Floats, y: Floats) -> Floats:
        """0 everywhere."""
        return np.zeros(np.broadcast(x, y).shape)


def _world(*obstacles: Obstacle) -> tuple[World, Sight]:
    world = World(Flat(), obstacles, 0.7, (34.1, -117.5), (0.0, 0.0, 0.0), SKY)
    sight = Sight(world)
    sight.set_ground(np.zeros((360, 360)), -90.0, -90.0, 0.5)
    return world, sight


def lidar_noise() -> Check:
    """Of a scanner that stands before walls: per beam, over many scans."""
    walls = [
        Obstacle(f"wall_{k}", "wall", "box", (2.0 + 2.0 * k, 3.0 * k - 9.0, 1.0), (0.1, 1.5, 1.0))
        for k in range(7)
    ]
    scanner = Lidar("lidar_bumper", _world(*walls)[1], 0, P.lidar, EXACT)
    view = Standing((0.0, 0.0, 0.55))
    range_m = np.array([scanner.measure(view, k).range_m for k in range(SCANS)])
    steady = (range_m < 16.0).all(axis=0) & (np.ptp(range_m, axis=0) < 0.1)  # no edges
    sd, mean = range_m[:, steady].std(axis=0), range_m[:, steady].mean(axis=0)
    order = np.argsort(mean)
    counts = range_m[:, steady] / LIDAR_COUNT_M
    assert np.allclose(counts, np.rint(counts), atol=1e-6)
    return Check(
        title="LIDAR noise at rest, 2 to 16 m, in counts of 1 cm: standard deviation",
        unit="mm", twin=1e3 * float(np.sqrt(np.mean(sd**2))), allowed=Range(5.0, 6.0),
        grade="measured", source="100 scans of a real LMS 221 standing still: 5 to 6 mm",
        curve=Curve(mean[order], "range [m]", "sd [mm]", {"twin": 1e3 * sd[order]}, points=True),
    )  # fmt: skip


def gps_cep() -> Check:
    """Half of the fixes of converged receivers in the open lie within it."""
    world, sight = _world()
    view = Standing((0.0, 0.0, 2.0))
    error = np.empty(RECEIVERS)
    for seed in range(RECEIVERS):
        receiver = Gps(world, sight.solid, seed, P.gps, EXACT)
        fix = [receiver.measure(view, k) for k in range(LOCKED)][-1]
        assert fix.quality is GpsQuality.CONVERGED
        east, north = _metres(world, fix.latitude_deg, fix.longitude_deg)
        error[seed] = np.hypot(east, north)
    share, sorted_m = np.linspace(0.0, 1.0, RECEIVERS), np.sort(error)
    return Check(
        title="GPS in the open: circular error probable", unit="m", twin=float(np.median(error)),
        grade="published", source="ProPak-LB with OmniSTAR HP, converged: 0.10 m CEP",
        remark="Over as many receivers: the error of one wanders over minutes.",
        curve=Curve(sorted_m, "error [m]", "share of fixes", {"twin": share}),
        allowed=within(0.10, 0.1),
    )  # fmt: skip


def _metres(world: World, latitude_deg: float, longitude_deg: float) -> tuple[float, float]:
    from twin.earth import to_world

    east, north = to_world(world.anchor, np.array(latitude_deg), np.array(longitude_deg))
    return float(east), float(north)


def tunnel_sky() -> Check:
    """Share of fixes inside the NQE's tunnel, by geometry alone."""
    course = build_nqe(0)
    axis = course.tunnel_center_line_m
    assert axis is not None
    sight = Sight(course.world)
    ground = course.world.terrain.height(axis[1, :1], axis[1, 1:])[0]
    x0, y0 = axis[1] - 90.0
    sight.set_ground(np.full((360, 360), ground), float(x0), float(y0), 0.5)
    receiver = Gps(course.world, sight.solid, 0, P.gps, EXACT)
    seen, inside = [], []
    for along in np.linspace(-20.0, 20.0, 81):
        place = _on(axis, along)
        view = Standing((float(place[0]), float(place[1]), float(ground) + 1.98))
        fixes = [receiver.measure(view, k).satellites for k in range(P.gps.sky_interval)]
        seen.append(fixes[-1])
        inside.append(abs(along) < 15.24 - MOUTH_M)
    most = max(n for n, within_it in zip(seen, inside, strict=True) if within_it)
    return Check(
        title="Satellites seen in the tunnel, 3 m from its mouths and deeper: most", unit="",
        twin=float(most), allowed=Range(0.0, 3.0), grade="published",
        source="a metal tunnel without GPS (the paper); a fix needs four",
        curve=Curve(
            np.linspace(-20.0, 20.0, 81), "way from the tunnel's middle [m]", "satellites",
            {"twin": np.array(seen, np.float64)},
        ),
    )  # fmt: skip


def _on(axis: Floats, along_m: float) -> Floats:
    """A point of the centre line (3, 2), `along_m` from its middle."""
    end = axis[2] if along_m > 0.0 else axis[0]
    unit = (end - axis[1]) / np.linalg.norm(end - axis[1])
    return axis[1] + abs(along_m) * unit


def gyro_noise() -> Check:
    """Angle random walk from the Allan deviation at 1 s, where white noise rules."""
    rates = _rates(P.imu, seeds=1, samples=60_000)
    averaged = np.unique(np.geomspace(10, 6000, 24).astype(int))
    found = np.sqrt(np.mean([allan_deviation(r, 0.01, averaged) ** 2 for r in rates], axis=0))
    tau = averaged * 0.01
    given = P.imu.gyro_noise_radps / np.sqrt(P.imu.rate_hz)
    at_1s = float(np.interp(1.0, tau, found))
    lines = {"twin": found, "white noise": given / np.sqrt(tau)}
    return Check(
        title="Gyro: angle random walk, from the Allan deviation at 1 s", unit="deg/sqrt(h)",
        twin=float(np.degrees(at_1s)) * 60.0, grade="published",
        source="VG700: about 0.4 deg/sqrt(h), unverified",
        curve=Curve(tau, "averaging time [s]", "deviation [rad/s]", lines, log=True),
        allowed=within(float(np.degrees(given)) * 60.0, 0.1),
    )  # fmt: skip


def gyro_walk() -> Check:
    """Walk of the bias, from the Allan deviation at long averages, where it rules."""
    slow = msgspec.structs.replace(P.imu, rate_hz=5.0, gyro_noise_radps=1e-5)
    rates = _rates(slow, seeds=4, samples=20_000)
    averaged = np.unique(np.geomspace(20, 2000, 20).astype(int))
    found = np.sqrt(np.mean([allan_deviation(r, 0.2, averaged) ** 2 for r in rates], axis=0))
    tau, given = averaged * 0.2, P.imu.gyro_walk_radps
    walk = float(np.exp(np.mean(np.log(found * np.sqrt(3.0 / tau)))))
    lines = {"twin": found, "rate random walk": given * np.sqrt(tau / 3.0)}
    return Check(
        title="Gyro: walk of the bias, from the Allan deviation (quiet gyros at 5 Hz)",
        unit="urad/s in 1 s", twin=1e6 * walk, grade="estimated",
        source="our parameter: a bias of 20 deg/h (published) wanders by about as much in hours",
        curve=Curve(tau, "averaging time [s]", "deviation [rad/s]", lines, log=True),
        allowed=within(1e6 * given, 0.1),
    )  # fmt: skip


def _rates(parameters: object, seeds: int, samples: int) -> list[Floats]:
    """Angular rates of gyros at rest: three axes of each."""
    view, found = Standing((0.0, 0.0, 0.0)), list[Floats]()
    for seed in range(seeds):
        imu = Imu(seed, parameters)  # pyright: ignore[reportArgumentType]
        rates = np.array([imu.measure(view, k).angular_rate_radps for k in range(samples)])
        found += list(rates.T)
    return found
