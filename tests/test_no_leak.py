"""The navigator never sees the simulator's truth: all that it hears is measured, with errors."""

from dataclasses import fields, replace

import numpy as np

from nav.messages import (
    ActuatorTargets,
    Floats,
    Gear,
    GpsFix,
    GpsQuality,
    LidarScan,
    RadarTracks,
    SensorMessage,
    VehicleState,
)
from scenarios.episode import Episode
from scenarios.nqe import build
from scenarios.route.course import build as build_route
from twin.simulator import Simulator

START_NS = 1_500_000_000
"""Before that GPS has no fix and says so in the same words."""


def heard(seed: int) -> dict[tuple[str, str, int], SensorMessage]:
    """Four seconds of a scripted drive, by type, sensor and time."""
    simulator = Simulator(build(0).world, seed)
    messages: dict[tuple[str, str, int], SensorMessage] = {}
    for k in range(200):
        now = k * 20_000_000
        targets = ActuatorTargets(now, 0.1, 0.3, 0.0, Gear.HIGH)
        for m in simulator.advance(targets):
            if m.time_ns > START_NS:
                messages[type(m).__name__, getattr(m, "sensor", ""), m.time_ns] = m
    return messages


def test_every_float_of_every_sensor_message_differs_between_two_seeds():
    one, other = heard(1), heard(2)
    assert one.keys() == other.keys()
    assert len({kind for kind, _, _ in one}) == 7
    for key, message in one.items():
        for f in fields(message):
            if f.type is float and not isinstance(message, VehicleState):
                assert getattr(message, f.name) != getattr(other[key], f.name), (key, f.name)


def test_what_comes_in_counts_differs_now_and_then():
    """Positions of actuators: a converter's step is about as large as their noise."""
    one, other = heard(1), heard(2)
    for name in ("steering_rad", "throttle", "brake"):
        keys = [key for key, m in one.items() if isinstance(m, VehicleState)]
        assert np.mean([getattr(one[k], name) == getattr(other[k], name) for k in keys]) < 0.7, name


def test_every_element_of_every_array_differs_between_two_seeds():
    """Ranges are counted in centimetres and end at a maximum, so single ones may coincide."""
    one, other = heard(1), heard(2)
    same: dict[tuple[str, str, str], np.ndarray] = {}
    for key, message in one.items():
        for f in fields(message):
            if f.type is Floats and not isinstance(message, RadarTracks):
                equal = getattr(message, f.name) == getattr(other[key], f.name)
                equal &= _measured(message, f.name)
                same.setdefault((key[0], key[1], f.name), []).append(equal)
    for name, rows in same.items():
        share = np.mean(rows, axis=0)
        assert share.max() < (0.6 if name[0] == "LidarScan" else 0.05), (name, share.max())


def test_no_number_of_a_radar_is_that_of_another_seed():
    one, other = heard(1), heard(2)
    tracks = [(m, other[key]) for key, m in one.items() if isinstance(m, RadarTracks)]
    assert sum(len(m.range_m) for m, _ in tracks) > 50
    for a, b in tracks:
        for name in ("range_m", "azimuth_rad", "range_rate_mps"):
            assert not np.isin(getattr(a, name), getattr(b, name)).any()


def _measured(message: SensorMessage, name: str) -> np.ndarray:
    """Which elements are measurements, not "nothing within range"."""
    value = getattr(message, name)
    limit = {"LidarScan": 81.9, "SonarScan": 3.99}.get(type(message).__name__, np.inf)
    return value < limit


def test_gps_outage_in_the_open_never_enters_tunnel_mode():
    rows = [f"{i + 1},34.0,{-117.0 + i * 3e-4:.9f},15,15,####,####,####" for i in range(8)]
    course = build_route("\n".join(rows), "straight.rddf", None, None, 5)
    episode = Episode(course, 5)
    advance = episode.simulator.advance

    def lost(fix):
        return replace(fix, quality=GpsQuality.NONE)

    outage = range(400, 10_000)
    states = set()
    tick = 0

    def advance_without_gps(targets):
        """A receiver without a solution goes on speaking."""
        heard = advance(targets)
        return [lost(m) if tick in outage and isinstance(m, GpsFix) else m for m in heard]

    episode.simulator.advance = advance_without_gps
    while episode.outcome is None and tick < 1500:
        episode.tick()
        states.add(episode.state)
        tick += 1
    assert episode.navigator.ego.gps_lost_s(episode.simulator.time_ns) > 10.0
    assert episode.truth.position_m[0] > 60.0
    assert "tunnel_mode" not in states


def test_lidar_scans_are_whole_counts():
    scans = [m for m in heard(1).values() if isinstance(m, LidarScan)]
    counts = np.concatenate([s.range_m for s in scans]) / 0.01
    np.testing.assert_allclose(counts, np.rint(counts), atol=1e-6)
