"""The way around a trap, and what is remembered of it."""

import numpy as np

from nav.planning.boundaries import REAL
from nav.planning.detour import ahead, target, way_around
from nav.planning.scanning import Boundaries
from nav.planning.wide_grid import CELLS, WideGrid

CELL_M = 0.8
ORIGIN = (-32.0, -32.0)


def grid(*blocks):
    level = np.zeros((80, 80), np.uint8)
    centre = -32.0 + (np.arange(80) + 0.5) * CELL_M
    for x0, x1, y0, y1 in blocks:
        level[np.ix_((centre > y0) & (centre < y1), (centre > x0) & (centre < x1))] = REAL
    return Boundaries(level, ORIGIN, CELL_M)


TRAP = grid((8, 10, -6, 6), (-4, 10, 5, 7), (-4, 10, -7, -5))
"""Open towards negative x."""


def length(way):
    return float(np.hypot(*np.diff(np.array(way), axis=0).T).sum())


def test_in_the_open_the_way_is_straight():
    way = way_around(grid(), (0, 0), (20, 0))
    assert 20.0 <= length(way) + CELL_M < 21.5


def test_a_trap_is_left_by_its_mouth():
    way = way_around(TRAP, (6, 0), (20, 0))
    assert min(x for x, _ in way) < -4.0
    assert all(TRAP.at(np.array(x), np.array(y)) < REAL for x, y in way)


def test_there_may_be_no_way():
    ring = grid((-6, 6, 4, 6), (-6, 6, -6, -4), (4, 6, -6, 6), (-6, -4, -6, 6))
    assert way_around(ring, (0, 0), (20, 0)) == []
    assert way_around(grid(), (0, 0), (90, 0)) == []


def test_the_next_goal_point_is_in_view():
    way = way_around(TRAP, (6, 0), (20, 0))
    x, _ = ahead(way, TRAP, (6, 0), 12.0)
    assert x < 6.0
    assert ahead([], TRAP, (6, 0), 12.0) is None


def test_the_target_lies_along_the_way_not_through_the_wall():
    way = way_around(TRAP, (6, 0), (20, 0))
    x, _ = target(way, (6, 0), 9.0)
    assert x < 0.0


def test_what_left_the_map_is_remembered():
    wide = WideGrid(0.2)
    level = np.zeros((320, 320), np.uint8)
    level[150:170, 300:310] = REAL  # 28 to 30 m ahead
    wide.update(Boundaries(level, ORIGIN, 0.2), 0.0, 0.0)
    before = int((wide.level == REAL).sum())
    empty = Boundaries(np.zeros((320, 320), np.uint8), (-52.0, -32.0), 0.2)
    wide.update(empty, -20.0, 0.0)
    assert before > 0
    assert int((wide.level == REAL).sum()) == before
    back = Boundaries(np.zeros((320, 320), np.uint8), ORIGIN, 0.2)
    wide.update(back, 0.0, 0.0)
    assert int((wide.level == REAL).sum()) == 0
    assert wide.level.shape == (CELLS, CELLS)
