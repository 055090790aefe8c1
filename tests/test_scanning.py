"""Scanning distances over feasible curves, with the whole outline."""

import numpy as np
import pytest

from nav.fusion.lattice import Lattice
from nav.parameters.loader import from_toml
from nav.parameters.planning import PlanningParameters
from nav.planning.boundaries import REAL, SAFE, TOUCH
from nav.planning.scanning import Boundaries, Turning, fan, free_distance, scan
from scenarios.parameter_files import parameter_texts

P = from_toml(PlanningParameters, parameter_texts()["planning.toml"], "planning.toml")
SLOW = Turning(curvature_per_m=0.0, delay_m=0.5, rate_per_m2=0.04, limit_per_m=0.15)
LATTICE = Lattice(0.2, 320, -160, -160)


def boundaries(*blocks: tuple[float, float, float, float, int]) -> Boundaries:
    """A free map with blocks (x low, x high, y low, y high, level)."""
    level = np.zeros((320, 320), np.uint8)
    centre = LATTICE.origin_m[0] + (np.arange(320) + 0.5) * LATTICE.cell_m
    for x0, x1, y0, y1, value in blocks:
        rows, columns = (centre > y0) & (centre < y1), (centre > x0) & (centre < x1)
        level[np.ix_(rows, columns)] = value
    return Boundaries(level, LATTICE.origin_m, LATTICE.cell_m)


def test_free_ground_is_free_in_all_directions():
    curves = fan(P.scanning, P.footprint, SLOW)
    safe, real, _ = scan(curves, boundaries(), P.footprint, 0.0, 0.0, 0.3)
    assert (real == P.scanning.max_distance_m).all()
    assert (safe == P.scanning.max_distance_m).all()


def test_wall_ahead_is_met_by_the_front_of_the_vehicle():
    curves = fan(P.scanning, P.footprint, SLOW)
    _, real, _ = scan(
        curves, boundaries((15.0, 16.0, -30.0, 30.0, REAL)), P.footprint, 0.0, 0.0, 0.0
    )
    ahead = real[len(real) // 2]
    assert ahead == pytest.approx(15.0 - max(P.footprint.disc_x_m), abs=P.scanning.step_m)


def test_safe_boundary_does_not_block_the_real_distance():
    curves = fan(P.scanning, P.footprint, SLOW)
    safe, real, _ = scan(
        curves, boundaries((10.0, 12.0, -30.0, 30.0, SAFE)), P.footprint, 0.0, 0.0, 0.0
    )
    assert (real == P.scanning.max_distance_m).all()
    assert safe[len(safe) // 2] < 10.0


def test_mirrored_world_gives_mirrored_distances():
    curves = fan(P.scanning, P.footprint, SLOW)
    _, left, _ = scan(curves, boundaries((8.0, 12.0, 0.6, 4.0, REAL)), P.footprint, 0.0, 0.0, 0.0)
    _, right, _ = scan(
        curves, boundaries((8.0, 12.0, -4.0, -0.6, REAL)), P.footprint, 0.0, 0.0, 0.0
    )
    np.testing.assert_array_equal(left, right[::-1])
    assert (left != right).any()


@pytest.mark.parametrize("curvature", [0.0, 0.08, -0.12])
def test_curves_start_as_the_vehicle_turns_and_end_in_their_direction(curvature):
    turning = Turning(curvature, delay_m=1.0, rate_per_m2=0.04, limit_per_m=0.12)
    curves = fan(P.scanning, P.footprint, turning)
    bend = np.diff(curves.heading_rad, axis=1) / P.scanning.step_m
    assert np.abs(bend).max() <= max(0.12, abs(curvature)) + 1e-9
    assert np.abs(np.diff(bend, axis=1)).max() <= 0.04 * P.scanning.step_m + 1e-9
    np.testing.assert_allclose(bend[:, 0], curvature, atol=1e-9)
    np.testing.assert_allclose(curves.heading_rad[:, -1], curves.theta_rad, atol=0.02)


def test_vehicle_inside_a_boundary_may_leave_it_but_not_cross_a_wall():
    arc = np.arange(0.0, 10.0, 0.5)
    level = np.zeros((1, 20), np.uint8)
    level[0, :5] = REAL
    assert free_distance(level, arc, REAL, P.footprint)[0] == arc[-1]
    for boundary, samples in ((REAL, 9), (TOUCH, 3)):
        level[0, :samples] = boundary
        assert free_distance(level, arc, REAL, P.footprint)[0] == 0.0


def test_boundaries_envelop_each_other_also_for_who_leaves_one():
    """Out of the safe boundary in time, but through the real one meanwhile."""
    curves = fan(P.scanning, P.footprint, SLOW)
    nose = max(P.footprint.disc_x_m)
    inside = boundaries((-3.0, nose + 1.6, -9, 9, SAFE), (nose + 0.9, nose + 1.5, -9, 9, REAL))
    found = scan(curves, inside, P.footprint, 0.0, 0.0, 0.0)
    assert (found.safe_m <= found.real_m).all()
    assert (found.real_m <= found.touch_m).all()
    assert found.real_m[len(found.real_m) // 2] == pytest.approx(1.0, abs=P.scanning.step_m)


def test_vehicle_leaves_the_real_boundary_by_the_soonest_way():
    arc = np.arange(0.0, 10.0, 0.5)
    level = np.zeros((3, 20), np.uint8)
    for row, samples in enumerate((1, 3, 6)):
        level[row, :samples] = REAL
    np.testing.assert_array_equal(
        free_distance(level, arc, REAL, P.footprint), [arc[-1], arc[-1], 0.0]
    )
