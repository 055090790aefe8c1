"""Angles on the circle."""

from math import nextafter, pi

import pytest

from nav.angles import wrapped


@pytest.mark.parametrize("turns", [-2, -1, 0, 1, 2])
@pytest.mark.parametrize("angle", [-3.0, -0.1, 0.0, 0.1, 3.0])
def test_whole_turns_do_not_matter(angle, turns):
    assert wrapped(angle + 2.0 * pi * turns) == pytest.approx(angle, abs=1e-12)


def test_half_a_turn_is_positive_whichever_way_round():
    assert wrapped(pi) == wrapped(-pi) == pi
    assert wrapped(nextafter(pi, 4.0)) < -3.14
