"""Which returns of a tick are obstacles, and which are ground, which is learned from them."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from nav.fusion.bumps import bumps
from nav.fusion.expected_ground import Bools, Expected
from nav.fusion.ground_profile import GroundProfile
from nav.fusion.scan_geometry import Pose, Scans, level_points, returns
from nav.messages import Floats
from nav.parameters.obstacle_map import NegativeParameters, ObstacleMapParameters

_NOWHERE = np.zeros((3, 0))


class Returns(NamedTuple):
    """Where beams ended, each of shape (3, n): east, north, height above the reference point."""

    obstacle_m: Floats
    bare_m: Floats
    """Flat ground that steep beams have met."""


def sorted_returns(
    ground: GroundProfile,
    p: ObstacleMapParameters,
    scans: Scans,
    steep: int,
    pose: Pose,
    expect: Expected | None,
) -> Returns:
    """Obstacles and flat ground among the returns of one tick.

    The first `steep` scans are those of scanners that look down. The ground learns from what they
    meet, and corrects its height; far away only where that continues what is known (`expect`).
    """
    beam = returns(scans, p.max_range_m)
    points = level_points(scans, beam)
    ends = beam.searchsorted([k * scans.range_m.shape[1] for k in range(steep + 1)]).tolist()
    x, y = points[0] - pose.x_m, points[1] - pose.y_m
    distance = np.sqrt(x * x + y * y)
    if ends[-1] == 0:
        obstacle, bare_m = ground.classify(points, distance)[0], _NOWHERE
    else:
        obstacle, bare_m = _sort_steep(ground, p, points, (x, y, distance), ends, expect)
    return Returns(points.take(np.flatnonzero(obstacle), axis=1), bare_m)


def _sort_steep(
    ground: GroundProfile,
    p: ObstacleMapParameters,
    points: Floats,
    away: tuple[Floats, Floats, Floats],
    ends: list[int],
    expect: Expected | None,
) -> tuple[Bools, Floats]:
    """Which points (3, n) are obstacles, (n,), and where flat ground was met.

    The points of steep scans come first, each scan's up to its end; their heights are corrected.
    """
    x, y, distance = away
    g, first = p.ground, slice(ends[-1])
    heights = [points[2, start:end] for start, end in pairwise(ends)]
    bump = np.concatenate([bumps(height, g.bump_beams) for height in heights])
    points[2, first] -= ground.too_high(x[first], y[first], distance[first])
    obstacle, level, coarse = ground.classify(points, distance)
    stands_out = level[first] & (bump > g.bump_m)
    obstacle[first] |= stands_out
    near = distance[first] < g.teaching_range_m
    place = np.stack([x[first], y[first], points[2, first]])
    teaches = _teaches(p.negative, place, distance[first], near, expect)
    met = level[first] & ~stands_out & teaches
    teaching = np.zeros_like(level)
    teaching[first] = met
    ground.learn(coarse, points[2], teaching, obstacle)
    bare_m = points[:, np.flatnonzero(met & (np.abs(bump) < g.flat_m))]
    # a steep beam's height is uncertain: what only such beams have seen (a bale) counts as so
    # low that a level beam, which passes over it, does not deny it
    points[2, first] -= g.tilt_rad * distance[first]
    return obstacle, bare_m


def _teaches(
    p: NegativeParameters,
    place: Floats,
    distance_m: Floats,
    near: Bools,
    expect: Expected | None,
) -> Bools:
    """Which ends of steep beams (3, n), from the vehicle, may teach: near ones, and those that
    continue the ground; not those on the low ground behind an edge, nor on the wall between."""
    if not p.enabled:
        return near
    if expect:
        within = distance_m < p.reach_m if expect.plane.far else near
        near = within & expect.continues(place, near)
    jump = np.abs(np.diff(place[2])) > p.doubt_m
    near[1:] &= ~jump
    near[:-1] &= ~jump
    return near
