"""The top-hat of one scan's heights: slopes and tilts vanish, narrow things stay."""

import numpy as np
import pytest

from nav.fusion.bumps import bumps

BEAMS = np.arange(361)


@pytest.mark.parametrize("tilt", [0.0, 0.01, -0.02])
def test_a_tilted_plane_has_no_bumps(tilt):
    np.testing.assert_allclose(bumps(tilt * BEAMS, 16), 0.0, atol=1e-12)


@pytest.mark.parametrize("tilt", [0.0, 0.005, -0.005])
def test_a_bale_stands_out_of_a_tilted_scan(tilt):
    height = tilt * BEAMS + np.where((BEAMS > 180) & (BEAMS < 197), 0.3, 0.0)
    found = bumps(height, 16)
    assert found[188] > 0.2
    assert found[:165].max() < 0.01
    assert found[215:].max() < 0.01


def test_what_is_wider_than_the_window_is_ground():
    height = np.where(BEAMS > 200, 0.3, 0.0)
    np.testing.assert_allclose(bumps(height, 16), 0.0)


def test_a_valley_has_no_bumps_and_few_returns_are_no_error():
    np.testing.assert_allclose(bumps(np.abs(BEAMS - 180) * 0.02, 16), 0.0, atol=1e-12)
    assert bumps(np.zeros(0), 16).shape == (0,)
    np.testing.assert_array_equal(bumps(np.arange(3.0), 16), 0.0)
