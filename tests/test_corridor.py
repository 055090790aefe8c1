import numpy as np
import pytest

from nav.route.corridor import depth, inside
from nav.route.waypoints import Waypoints

# East 100 m in a corridor of 4 m half-width, then north 50 m in one of 2 m.
CORNER = Waypoints(
    np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 50.0]]),
    np.array([4.0, 2.0, 2.0]),
    np.array([5.0, 5.0, 0.0]),
)


@pytest.mark.parametrize(
    ("point", "expected"),
    [
        ((50.0, 0.0), 4.0),
        ((50.0, 3.0), 1.0),
        ((50.0, -5.0), -1.0),
        ((100.0, 25.0), 2.0),
        ((103.0, 0.0), 1.0),  # in the disc that the wide segment brings to the corner
        ((103.0, 25.0), -1.0),
        ((-3.0, 0.0), 1.0),  # in the disc before the start
        ((100.0, 53.0), -1.0),
    ],
)
def test_depth_is_half_width_less_distance(point, expected):
    assert depth(np.array([point]), CORNER, 0, 1)[0] == pytest.approx(expected)


def test_only_the_named_segments_count():
    point = np.array([[100.0, 25.0]])
    assert inside(point, CORNER, 0, 1)[0]
    assert not inside(point, CORNER, 0, 0)[0]
    assert inside(point, CORNER, -2, 7)[0]


def test_margin_shrinks():
    points = np.array([[50.0, 3.0], [50.0, 3.5]])
    assert inside(points, CORNER, 0, 1).tolist() == [True, True]
    assert inside(points, CORNER, 0, 1, margin_m=0.762).tolist() == [True, False]


def test_many_points_agree_with_the_definition():
    """Against rectangles and discs, spelled out."""
    points = np.random.default_rng(3).uniform([-10, -10], [110, 60], (2000, 2))
    x, y = points.T
    rectangles = (abs(y) <= 4) & (x >= 0) & (x <= 100) | (abs(x - 100) <= 2) & (y >= 0) & (y <= 50)
    discs = (np.hypot(x, y) <= 4) | (np.hypot(x - 100, y) <= 4) | (np.hypot(x - 100, y - 50) <= 2)
    np.testing.assert_array_equal(inside(points, CORNER, 0, 1), rectangles | discs)
