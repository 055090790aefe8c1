"""The corridor's edges on the map, against the corridor's own definition."""

import numpy as np
import pytest

from nav.fusion.lattice import Lattice
from nav.planning import corridor_grid
from nav.planning.boundaries import FREE, REAL, SAFE, TOUCH
from nav.planning.corridor_grid import CorridorGrid
from nav.route.corridor import depth
from nav.route.waypoints import Waypoints

MARGIN_M = (1.2, 0.9, 0.7)
ROUTE = Waypoints(
    np.array([[-5.0, 0.0], [60.0, 3.0], [75.0, 60.0], [75.0, 60.0], [20.0, 75.0]]),
    np.array([4.0, 6.0, 3.0, 20.0, 3.0]),
    np.full(5, 5.0),
)
CENTRES_M = [(0.0, 0.0), (8.0, 1.0), (30.0, 10.0), (60.0, 20.0), (70.0, 60.0), (25.0, 70.0)]


def grid(route: Waypoints = ROUTE) -> CorridorGrid:
    return CorridorGrid(route.position_m, route.half_width_m, MARGIN_M)


def at(x_m: float, y_m: float) -> Lattice:
    return Lattice(0.2, 200).centred(x_m, y_m)


def by_definition(lattice: Lattice) -> np.ndarray:
    places = np.stack(lattice.centre_m(np.arange(lattice.count**2)), axis=1)
    inside_m = depth(places, ROUTE, 0, 3)
    level = np.sum([inside_m < margin for margin in MARGIN_M], axis=0)
    return level.reshape(lattice.count, lattice.count)


@pytest.mark.parametrize("centre_m", CENTRES_M)
def test_levels_are_those_of_the_definition(centre_m) -> None:
    lattice = at(*centre_m)
    found = grid().levels(lattice, 0, 4)
    assert set(np.unique(found)) == {FREE, SAFE, REAL, TOUCH}
    # on the very edge, single precision may say otherwise
    assert np.mean(found != by_definition(lattice)) < 1e-4


def test_a_map_that_moves_sees_what_a_new_one_sees() -> None:
    """Also where a wide segment's window ended at the edge of the old map."""
    moving = grid()
    for x_m, y_m in [*CENTRES_M, *CENTRES_M[::-1]]:
        found = moving.levels(at(x_m, y_m), 0, 4)
        np.testing.assert_array_equal(found, grid().levels(at(x_m, y_m), 0, 4))


def test_what_was_drawn_is_not_drawn_again(monkeypatch: pytest.MonkeyPatch) -> None:
    moving = grid()
    moving.levels(at(10.0, 0.0), 0, 2)
    expected = grid().levels(at(18.0, 0.0), 0, 2)
    monkeypatch.delattr(corridor_grid, "_draw")
    np.testing.assert_array_equal(moving.levels(at(18.0, 0.0), 0, 2), expected)


def test_only_the_named_segments_count() -> None:
    assert (grid().levels(at(0.0, 0.0), 1, 2) == TOUCH).all()


def test_a_corridor_wider_than_the_map_confines_nothing() -> None:
    wide = Waypoints(np.array([[0.0, 0.0], [100.0, 0.0]]), np.array([60.0, 60.0]), np.ones(2))
    assert (grid(wide).levels(at(50.0, 0.0), 0, 1) == FREE).all()
    assert (grid(wide).levels(at(50.0, 38.6), 0, 1) == FREE).all()
    assert grid(wide).levels(at(50.0, 39.2), 0, 1).max() == SAFE
