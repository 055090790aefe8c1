"""The ego state says truly how well it knows: its covariance against its errors, in many runs.

The sensors err here as `ego_state.toml` says that they do, with another draw of their slow errors
in each run; test_ego_state.py has the data sheets' figures, which are smaller.
"""

import math

import numpy as np
import pytest
from test_ego_state import FRAME, PARAMETERS, TICK_NS, VEHICLE, Errors, Sensors, Truth, loop, run

from nav.fusion.ego_filter import GPS_X
from nav.fusion.ego_state import EgoState
from nav.messages import GpsQuality

RUNS = 40
AT_S = (6.0, 10.0, 14.0)
"""On the straight, in the bend, and in the bend for longer."""
BEYOND = {2: (1.12, 3.18), 3: (1.88, 4.42)}
"""Chi-square with 40 n degrees of freedom, over 40: 99.9 % lie within (Wilson and Hilferty)."""
JUMPS_M = (5.0, 20.0, 100.0)


def drawn(rng: np.random.Generator) -> Errors:
    """Standard deviations of `ego_state.toml`, the slow errors drawn from them."""
    p = PARAMETERS
    slow = rng.normal(size=3)
    return Errors(
        gps_m=0.1,
        gps_white_m=math.hypot(p.gps.white_m, 0.1 * p.gps.white_share),
        velocity_mps=p.gps.velocity_sd_mps,
        gyro_radps=p.motion.gyro_radps / math.sqrt(TICK_NS * 1e-9),
        gyro_bias_radps=p.motion.gyro_bias_start_radps * slow[0],
        compass_rad=p.compass.sd_rad,
        compass_bias_rad=p.compass.bias_start_rad * slow[1],
        wheel_scale=p.wheels.scale_start * slow[2],
        wheels_mps=p.wheels.sd_mps,
    )


def squared_errors(seed: int) -> list[tuple[float, float]]:
    """NEES of (x, y) and of (x, y, heading) at each of the times."""
    ego, truth, found = EgoState(PARAMETERS, VEHICLE, FRAME), Truth(), []
    sensors = Sensors(seed, drawn(np.random.default_rng((7, seed))))
    for tick in range(round(AT_S[-1] * 100) + 1):
        for message in sensors.messages(truth, tick):
            ego.update(message)
        if tick / 100 in AT_S:
            pose = ego.pose_at(tick * TICK_NS)
            turned = math.remainder(pose.heading_rad - truth.heading, 2 * math.pi)
            error = np.array([pose.x_m - truth.x, pose.y_m - truth.y, turned])
            P = ego.filter.covariance
            found.append(tuple(nees(error[:n], P[:n, :n]) for n in BEYOND))
        truth.drive(*loop(tick / 100), TICK_NS * 1e-9)
    return found


def nees(error: np.ndarray, covariance: np.ndarray) -> float:
    return float(error @ np.linalg.solve(covariance, error))


def test_the_covariance_is_consistent_with_the_errors():
    """Neither over-confident nor timid, at any of the times."""
    mean = np.mean([squared_errors(seed) for seed in range(RUNS)], axis=0)
    for k, (low, high) in enumerate(BEYOND.values()):
        assert (mean[:, k] > low).all(), mean
        assert (mean[:, k] < high).all(), mean


# ---------------------------------------------------------------- a GPS that jumps


@pytest.fixture(scope="module")
def steady():
    return places(run(Sensors(4), 30))


def places(log) -> np.ndarray:
    return np.array([estimate.position_m for estimate in log.estimates])


def jumping(way_m: float, lasts_s: float):
    """The drive with all fixes from 20 s on displaced for a while."""

    def script(second, sensors, truth):
        off = 20.0 <= second < 20.0 + lasts_s
        sensors.jump = np.array([0.6, -0.8]) * way_m * off

    return run(Sensors(4), 30, script=script)


@pytest.mark.parametrize("way_m", JUMPS_M)
@pytest.mark.parametrize("lasts_s", [0.05, 1.0, 2.8])
def test_a_jump_that_goes_back_is_refused(way_m, lasts_s, steady):
    moved = np.linalg.norm(places(jumping(way_m, lasts_s)) - steady, axis=1)
    assert moved.max() < (0.01 if lasts_s < 0.1 else 0.05)


@pytest.mark.parametrize("way_m", JUMPS_M)
def test_a_jump_that_lasts_is_believed_after_patience(way_m, steady):
    """It was the estimate that was wrong, or nobody will ever know; and so when it goes back."""
    log = jumping(way_m, 5.0)
    moved, second = np.linalg.norm(places(log) - steady, axis=1), log.second
    patience_s = PARAMETERS.gate.patience_s
    believed = (second > 20.2 + patience_s) & (second < 25.0)
    assert moved[second < 20.0 + patience_s].max() < 0.05
    np.testing.assert_allclose(moved[believed], way_m, atol=0.1)
    assert moved[second > 25.2 + patience_s].max() < 0.1


# ---------------------------------------------------------------- after a tunnel


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_accuracy_from_before_the_tunnel_is_carried_through_the_reconvergence(seed):
    """Fixes come back 1.5 m off, say so, and converge in a minute. Their offset is known as a slow
    bias: most of it is estimated, little of it is followed."""

    def script(second, sensors, truth):
        inside, since = 20.0 <= second < 30.0, second - 30.0
        sensors.quality = GpsQuality.NONE if inside else GpsQuality.CONVERGED
        if since >= 0.0:
            sensors.quality = GpsQuality.DIFFERENTIAL
            sensors.sd_m = max(1.0 * math.exp(-since / 25.0), 0.1)
            sensors.offset = np.array([1.2, -0.9]) * sensors.sd_m

    def plan(second):
        return min(max(second - 3.0, 0.0), 2.2), 0.05 * math.sin(0.2 * second)

    ego = EgoState(PARAMETERS, VEHICLE, FRAME)
    sensors = Sensors(seed)
    log = run(sensors, 75, plan, ego=ego, script=script)
    error = np.hypot(log.ahead_m, log.cross_m)
    before, after = error[log.second < 20.0][-1], log.second > 30.0
    assert error[after].max() < before + 0.15
    known_m = ego.filter.state[GPS_X:] * sensors.sd_m
    assert np.linalg.norm(known_m - sensors.offset) < 0.6 * np.linalg.norm(sensors.offset)


# ---------------------------------------------------------------- its health


def test_it_tells_for_how_long_a_source_has_been_refused():
    """And that there are no fixes: `gps_lost_s`, in test_ego_state.py."""
    ego = EgoState(PARAMETERS, VEHICLE, FRAME)

    def script(second, sensors, truth):
        sensors.jump = np.array([20.0, 0.0]) if second >= 10.0 else np.zeros(2)

    run(Sensors(4), 12, ego=ego, script=script)
    refused_s = ego.refused_s(12_000_000_000)
    assert list(refused_s) == ["gps position"]
    assert refused_s["gps position"] == pytest.approx(2.0, abs=0.06)
    run_on = EgoState(PARAMETERS, VEHICLE, FRAME)
    run(Sensors(4), 12, ego=run_on)
    assert run_on.refused_s(12_000_000_000) == {}


def test_the_stated_deviation_grows_while_there_are_no_fixes():
    def script(second, sensors, truth):
        sensors.quality = GpsQuality.NONE if second >= 10.0 else GpsQuality.CONVERGED

    log = run(Sensors(4), 25, script=script)
    sd = np.array([estimate.position_sd_m for estimate in log.estimates])
    assert sd[-1] > 1.5 * sd[log.second < 10.0][-1]
    error = np.hypot(log.ahead_m, log.cross_m)
    assert error[-1] < 3.0 * sd[-1]
