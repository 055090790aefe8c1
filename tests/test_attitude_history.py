"""The attitude at a moment that has just passed."""

import pytest

from nav.fusion.attitude_history import AttitudeHistory
from nav.fusion.ego_kinematics import Attitude


def history() -> AttitudeHistory:
    kept = AttitudeHistory()
    for k in range(100):
        kept.add(k * 10_000_000, Attitude(0.001 * k, -0.002 * k, (0.1, -0.2, 0.0)))
    return kept


@pytest.mark.parametrize("time_ms", [990, 985, 961.5, 800])
def test_between_samples_it_is_interpolated(time_ms):
    found = history().at(int(time_ms * 1e6))
    assert found.roll_rad == pytest.approx(0.0001 * time_ms)
    assert found.pitch_rad == pytest.approx(-0.0002 * time_ms)


def test_beyond_the_newest_it_follows_the_rates_and_before_the_oldest_it_stands():
    assert history().at(1_000_000_000).roll_rad == pytest.approx(0.1)
    assert history().at(0) == history().at(100_000_000)
    assert AttitudeHistory().at(5) == Attitude()
