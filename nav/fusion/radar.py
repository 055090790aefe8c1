"""Radar tracks in the map: near one, what a scanner sees counts for more.

A track says how far away something stands to within 5 %, and not how wide it is. Cells marked from
it would lie up to a metre before and behind the thing, and shut the gate whose post it is. So a
track marks nothing: it is a second witness. Where a return of a scanner lies within a track's
uncertainty, that one return makes an obstacle, which else takes two. What decays goes on decaying:
no track holds up what the scanners see no longer.

Tracks are placed with the estimate at the time of their measurement. What moves by itself has gone
on since, within 0.2 s: below 4 m/s by less than the uncertainty of its range.
"""

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from nav.fusion.expected_ground import Bools
from nav.fusion.scan_geometry import Pose
from nav.messages import Floats, RadarTracks
from nav.parameters.vehicle import Radar


class Echoes(NamedTuple):
    """Where n tracks may be, route frame N: first n rows along the tracks, then n across them."""

    axes: Floats
    """Shape (2n, 2): unit vectors from the radar to each track, and the same turned to the left."""
    centre_m: Floats
    """Shape (2n, 1): each track's place on its axes."""
    error_m: Floats
    """Shape (2n, 1): how far it may be from there, to either side."""

    def near(self, place_m: Floats) -> Bools:
        """Which places (2, k) lie within the uncertainty of a track."""
        within = np.abs(self.axes @ place_m - self.centre_m) <= self.error_m
        n = len(within) // 2
        return np.logical_or.reduce(within[:n] & within[n:], axis=0)


def echoes(tracks: RadarTracks, radar: Radar, pose: Pose) -> Echoes:
    """Tracks as they lie in N.

    Args:
        tracks: the newest ones.
        radar: its mounting and its errors.
        pose: the estimate at the time of the tracks.
    """
    heading, range_m = pose.heading_rad, tracks.range_m
    bearing = heading + radar.yaw_rad + tracks.azimuth_rad
    direction = np.concatenate([bearing, bearing + pi / 2])
    axes = np.array([np.cos(direction), np.sin(direction)]).T
    x, y, _ = radar.position_m
    from_x = pose.x_m + cos(heading) * x - sin(heading) * y
    from_y = pose.y_m + sin(heading) * x + cos(heading) * y
    centre = axes @ np.array([from_x, from_y])
    centre[: len(range_m)] += range_m
    along_m = np.maximum(radar.range_error_m, radar.range_error_share * range_m)
    error = np.concatenate([along_m, radar.azimuth_error_rad * range_m])
    return Echoes(axes, centre[:, None], error[:, None])
