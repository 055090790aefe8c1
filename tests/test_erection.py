"""The navigator follows what accelerations do to its vertical gyro."""

import pytest

from nav.fusion.erection import Erection


def test_a_long_bend_to_the_left_lifts_the_left_side_in_appearance():
    erection = Erection(60.0)
    for _ in range(1000):
        erection.follow(1.962, 0.0, 0.01)
    assert erection.roll_rad == pytest.approx(0.2 * (1 - 2.718281828 ** (-10 / 60)), rel=0.01)
    assert erection.pitch_rad == 0.0


def test_speeding_up_lifts_the_nose_and_it_comes_back():
    erection = Erection(60.0)
    for _ in range(500):
        erection.follow(0.0, 2.0, 0.01)
    assert erection.pitch_rad < -0.01
    for _ in range(30_000):
        erection.follow(0.0, 0.0, 0.01)
    assert abs(erection.pitch_rad) < 2e-4
