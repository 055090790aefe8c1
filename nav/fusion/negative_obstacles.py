"""Negative obstacles: where beams that look down should have met ground and went on below it.

A beam of a scanner that looks down and has passed by `drop_m` below the lowest that ground may lie
there (`expected_ground`), or that never came back, has shown a drop. It begins where the beam
crossed that floor, and reaches as far as the beam passed below it.

A scanner sweeps over an edge once, some 18 m ahead. Behind it the beam goes on above the low
ground, and soon the known ground is too far away to say what should have been there, so only the
first metre of the sweep speaks. Ground that falls by as much as courses do (0.08) is met by the
next scans already, and so never lies far from known ground. A drop is wide: a few beams that find a
gap between obstacles, whose ground nobody has seen, show none. A beam that ends on the floor again
has shown none, and one that ends on an obstacle ends above it; what lies behind a crest that falls
as steeply as the beams is a drop to them.
"""

import numpy as np

from nav.fusion.expected_ground import Bools, Expected, Floor
from nav.fusion.ground_profile import UNKNOWN_M, GroundProfile
from nav.fusion.lattice import Ints
from nav.fusion.scan_geometry import Pose, Scans
from nav.messages import Floats
from nav.parameters.obstacle_map import NegativeParameters

SAMPLE_M = 1.5
BEYOND_M = SAMPLE_M * np.arange(1.0, 6.0)
"""How far behind its crossing of the plane a beam is compared with the floor."""
MARK_M = np.arange(-0.2, SAMPLE_M * 5.0, 0.2)
"""Where a drop may be marked along a beam, from its edge: closer than cells. A wheel needs the last
bit of ground before the edge too."""
NOTHING = np.zeros((2, 0))


def drops(scans: Scans, expect: Expected, pose: Pose) -> Floats:
    """Places at which beams of scanners that look down show a drop.

    Args:
        scans: k of such scanners.
        expect: where the ground should be.
        pose: of the vehicle now.

    Returns:
        East and north in N, shape (2, n), [m]: all marks of all beams.
    """
    p, plane = expect.parameters, expect.plane
    if not plane.far:
        return NOTHING
    inner = _inner(scans, p.fan_rad)
    origin, way = _rays(scans, inner, pose, expect.ground)
    over = plane.over(origin)  # (k, 1)
    fall = plane.rise(way[0], way[1]) - way[2]  # (k, beams), for each metre of beam
    crossing = over / np.maximum(fall, p.fall_min)
    long = scans.range_m[:, inner] > crossing + BEYOND_M[0]
    scan, beam = np.nonzero(long & (crossing < p.reach_m) & (fall > p.fall_min))
    if not scan.size:
        return NOTHING
    crossing, fall = crossing[scan, beam, None], fall[scan, beam, None]
    start, way = origin[:2, scan], way[:2, scan, beam, None]  # (2, n, 1) each
    range_m = scans.range_m[:, inner][scan, beam, None]
    edge, end = _below(expect.floor, start, way, crossing, fall, range_m, p)
    wide = _in_wide_runs(scan, beam, end[:, 0] > -UNKNOWN_M, p.least_beams)
    end = np.where(wide[:, None], end, -UNKNOWN_M)
    marks = edge + MARK_M
    place = start + way * marks + np.array([pose.x_m, pose.y_m])[:, None, None]
    return place[:, marks <= end]


def _below(
    floor: Floor, start: Floats, way: Floats, crossing: Floats, fall: Floats, range_m: Floats,
    p: NegativeParameters,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Where beams cross the floor and how far they go on below it, (n, 1); no way for most."""
    at = crossing + BEYOND_M  # (n, samples)
    over = floor.at(*(start + way * at))
    below = np.where(at < range_m, over + fall * BEYOND_M, -UNKNOWN_M)
    deep: Bools = (below > p.drop_m) & _ends_low(floor, start, way, crossing, fall, range_m, p)
    first = np.take_along_axis(over, (below > 0.0).argmax(axis=1)[:, None], axis=1)
    edge = crossing - np.maximum(first, -1.0) / fall
    last = BEYOND_M[-1] - SAMPLE_M * np.flip(deep, axis=1).argmax(axis=1)[:, None]
    end = np.minimum(range_m, crossing + last + SAMPLE_M)
    return edge, np.where(np.any(deep, axis=1, keepdims=True), end, -UNKNOWN_M)


def _ends_low(
    floor: Floor, start: Floats, way: Floats, crossing: Floats, fall: Floats, range_m: Floats,
    p: NegativeParameters,
) -> Bools:  # fmt: skip
    """Which beams end below the floor, or where nothing is known, (n, 1).

    Who only passes below it has passed beside a thing whose foot was taken for ground."""
    end = np.minimum(range_m, crossing + BEYOND_M[-1])
    over = floor.at(*(start + way * end))
    return (over + fall * (end - crossing) > p.drop_m) | (over <= -UNKNOWN_M)


def _in_wide_runs(scan: Ints, beam: Ints, deep: Bools, least: int) -> Bools:
    """Which of the beams (n,), ordered by scan, are deep and have enough deep neighbours."""
    index = np.flatnonzero(deep)
    apart = (np.diff(beam[index]) != 1) | (np.diff(scan[index]) != 0)
    run = np.concatenate([[0], np.cumsum(apart)])[: index.size]
    wide = np.zeros(len(deep), bool)
    wide[index] = np.bincount(run, minlength=1)[run] >= least
    return wide


def _inner(scans: Scans, fan_rad: float) -> slice:
    """The beams within `fan_rad` of a scanner's middle."""
    fan, count = scans.geometry[0], scans.range_m.shape[1]
    first = max(int(np.ceil((-fan_rad - fan.first_rad) / fan.step_rad)), 0)
    return slice(first, count - first)


def _rays(scans: Scans, inner: slice, pose: Pose, ground: GroundProfile) -> tuple[Floats, Floats]:
    """Origins (3, k, 1) from the vehicle and directions (3, k, beams), level axes."""
    way = (scans.frame[:, :, :2] @ scans.geometry[0].ray[:, inner]).swapaxes(0, 1)
    origin = scans.frame[:, :, 2].T[:, :, None] - np.array([pose.x_m, pose.y_m, 0.0])[:, None, None]
    way[2] -= ground.too_high(way[0], way[1], 1.0)
    return origin, way
