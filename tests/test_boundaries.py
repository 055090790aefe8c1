"""The boundaries against a slow expansion that measures every distance."""

import numpy as np
import pytest

from nav.errors import NavError
from nav.planning.boundaries import FREE, REAL, SAFE, TOUCH, boundaries

COUNT, CELL_M = 60, 0.2


def slow(occupied: np.ndarray, radius_m: tuple[float, float]) -> np.ndarray:
    row, column = np.divmod(np.arange(COUNT * COUNT), COUNT)
    r, c = np.divmod(occupied, COUNT)
    distance = np.hypot(row[:, None] - r, column[:, None] - c).min(axis=1) * CELL_M
    level = np.where(distance <= radius_m[0] + 1e-9, SAFE, FREE)
    return np.where(distance <= radius_m[1] + 1e-9, REAL, level).reshape(COUNT, COUNT)


@pytest.mark.parametrize("radius_m", [(1.5, 0.95), (0.2, 0.0), (1.0, 1.0), (4.4, 0.6)])
def test_it_equals_the_slow_expansion(radius_m: tuple[float, float]) -> None:
    occupied = np.random.default_rng(3).choice(COUNT * COUNT, 25, replace=False)
    found = boundaries(occupied, COUNT, CELL_M, radius_m)
    assert np.array_equal(found, slow(occupied, radius_m))


def test_edges_of_the_grid_do_not_leak() -> None:
    corners = np.array([0, COUNT - 1, COUNT * (COUNT - 1), COUNT * COUNT - 1])
    found = boundaries(corners, COUNT, CELL_M, (1.5, 0.95))
    assert np.array_equal(found, slow(corners, (1.5, 0.95)))


def test_three_boundaries_envelop_each_other() -> None:
    found = boundaries(np.array([30 * COUNT + 30]), COUNT, CELL_M, (0.8, 0.4, 0.2))
    assert list(found[30, 25:31]) == [FREE, SAFE, SAFE, REAL, TOUCH, TOUCH]


def test_no_obstacle_is_all_free() -> None:
    found = boundaries(np.array([], np.int64), COUNT, CELL_M, (1.5, 0.95))
    assert found.dtype == np.uint8
    assert np.all(found == FREE)


def test_its_arguments_are_left_alone() -> None:
    occupied = np.array([100, 200])
    boundaries(occupied, COUNT, CELL_M, (1.5, 0.95))
    assert list(occupied) == [100, 200]


@pytest.mark.parametrize("radius_m", [-0.1, 13.0, float("nan")])
def test_a_useless_radius_is_refused(radius_m: float) -> None:
    with pytest.raises(NavError, match="must be within 0 and 63"):
        boundaries(np.array([5]), COUNT, CELL_M, (1.5, radius_m))
