"""Robotic unit operations lead out of where no forward path does, and touch nothing."""

import numpy as np
import pytest

from nav.messages import Gear
from nav.parameters import parameters_from
from nav.planning.arcs import arc_poses, free_arc, levels, placed
from nav.planning.boundaries import TOUCH, boundaries
from nav.planning.scanning import Boundaries
from nav.planning.unit_operations import Arc, merged, search
from scenarios.parameter_files import parameter_texts

P = parameters_from(parameter_texts())
FOOT = P.planning.footprint


def world(*blocks):
    occupied = np.zeros((320, 320), bool)
    centre = -32.0 + (np.arange(320) + 0.5) * 0.2
    for x0, x1, y0, y1 in blocks:
        rows, columns = (centre > y0) & (centre < y1), (centre > x0) & (centre < x1)
        occupied[np.ix_(rows, columns)] = True
    radius = (FOOT.safe_radius_m, FOOT.real_radius_m, FOOT.touch_radius_m)
    level = boundaries(np.flatnonzero(occupied.ravel()), 320, 0.2, radius)
    return Boundaries(level, (-32.0, -32.0), 0.2)


def found(goal, *blocks, back_first=False):
    s = search(P, (0.0, 0.0, 0.0), [goal], world(*blocks), back_first)
    while s.found is None and not s.exhausted:
        s.advance()
    return s


def driven(way):
    """Poses along the operations, (x, y, heading) each quarter of a metre."""
    pose, poses = (0.0, 0.0, 0.0), []
    for arc in way:
        sign = -1.0 if arc.gear == Gear.REVERSE else 1.0
        s = sign * np.arange(0.0, arc.length_m + 1e-9, 0.25)[None]
        place, heading = placed(pose, *arc_poses(np.array([[arc.curvature_per_m]]), s))
        poses += list(zip(place[0, 0], place[1, 0], heading[0], strict=True))
        pose = poses[-1]
    return poses


def test_where_forward_is_free_nothing_is_to_be_done():
    assert found((20.0, 0.0)).found == ()


def test_where_forward_was_in_vain_the_way_out_begins_backwards():
    way = found((20.0, 0.0), back_first=True).found
    assert way
    assert way[0].gear == Gear.REVERSE


@pytest.mark.parametrize(
    ("goal", "blocks"),
    [
        ((15.0, 0.0), [(4, 5, -10, 1.5)]),
        ((2.0, 15.0), [(5, 6, -3, 20), (-20, 6, -4, -3), (-20, -0.5, 3, 20)]),
        ((-20.0, 0.0), [(-30, 30, 6, 7), (-30, 30, -7, -6)]),
    ],
)
def test_operations_lead_out_and_touch_nothing(goal, blocks):
    way = found(goal, *blocks).found
    assert way
    poses = np.array(driven(way))
    level = levels(poses[:, :2].T, poses[:, 2], world(*blocks), FOOT)
    assert level.max() < TOUCH
    assert sum(arc.length_m for arc in way) <= P.planning.operations.most_way_m


def test_a_closed_room_is_given_up():
    room = [(-6, 6, 4, 5), (-6, 6, -5, -4), (5, 6, -5, 5), (-6, -5, -5, 5)]
    s = found((20.0, 0.0), *room)
    assert s.found is None
    assert s.exhausted


def test_a_decision_looks_at_few_poses():
    s = search(P, (0.0, 0.0, 0.0), [(-20.0, 0.0)], world((-30, 30, 6, 7), (-30, 30, -7, -6)))
    s.advance()
    children = 6 * len(P.planning.operations.lengths_m)
    assert s._count <= 1 + children * P.planning.operations.poses_a_decision


def test_arcs_are_circles_in_both_gears():
    way = np.array([[0.0, 3.0], [0.0, -3.0]])
    place, heading = arc_poses(np.array([[0.1], [0.1]]), way)
    np.testing.assert_allclose(heading[:, 1], [0.3, -0.3])
    np.testing.assert_allclose(place[:, :, 1], [[10 * np.sin(0.3), -10 * np.sin(0.3)],
                                                [10 * (1 - np.cos(0.3))] * 2])  # fmt: skip


def test_an_arc_is_free_up_to_what_is_behind():
    wall = world((-6, -5, -5, 5))
    free = free_arc((0.0, 0.0, 0.0), 0.0, -8.0, wall, FOOT)
    assert free == pytest.approx(5.0 - 0.44 - FOOT.touch_radius_m, abs=0.45)


def test_pieces_of_one_kind_are_one_operation():
    a, b = Arc(Gear.REVERSE, 0.1, 1.0), Arc(Gear.REVERSE, 0.0, 2.0)
    assert merged((a, a, b)) == (Arc(Gear.REVERSE, 0.1, 2.0), b)
