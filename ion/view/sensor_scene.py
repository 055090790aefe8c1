"""What the sensors see, what the navigator makes of it, and where it wants to go."""

from collections.abc import Set as AbstractSet

import numpy as np
import viser

from ion.style import DECIDED, INK, QUIET, REAL, SAFE, SEEN, TRACK
from ion.view.canvas import Canvas, Precision
from ion.view.places import Floats, Places
from ion.view.shapes import edges, rgb, segments
from ion.view.timeline import Moment, Timeline
from nav.fusion.scan_geometry import scan_geometry
from nav.messages import (
    LIDAR_NO_RETURN_M,
    FollowPath,
    LidarScan,
    ObstacleCells,
    SonarScan,
)
from nav.parameters import Parameters
from nav.planning.boundaries import REAL as REAL_LEVEL
from nav.planning.boundaries import SAFE as SAFE_LEVEL
from nav.planning.boundaries import boundaries

SCAN_COLORS = ("#d1495b", "#1f78b4", "#6a3d9a", "#138a72", QUIET)
"""Of the scanners, in the order of the vehicle's parameters."""
OLD_S = 0.5
"""A scan older than this is not shown."""
ABOVE_M = {"boundary": 0.12, "cells": 0.2, "path": 0.3, "track": 0.1}
TRACK_EVERY = 5
"""Every fifth place of a track is drawn: 0.5 s."""
PAD = 12
"""Cells around the obstacles, so that their boundaries have room."""


LAYERS = {
    "LIDAR points": ("/lidar",), "sonar": ("/vehicle/sonar",), "obstacle cells": ("/map/cells",),
    "boundaries": ("/map/boundaries",), "local path": ("/path",), "trajectory": ("/tracks",),
}  # fmt: skip
"""What one may hide."""


class SensorScene:
    """Draws it, and remembers what is already drawn.

    Args:
        scene: drawn in.
        places: of the course.
        parameters: the navigator's, as on the tape.
        precision: of points.
    """

    def __init__(
        self, scene: viser.SceneApi, places: Places, parameters: Parameters,
        precision: Precision = "float32",
    ) -> None:  # fmt: skip
        self._places, self._parameters = places, parameters
        groups = tuple(name for group in LAYERS.values() for name in group)
        self._canvas = Canvas(scene, groups, precision)
        vehicle = parameters.vehicle
        self._geometry = {
            name: scan_geometry(mount, vehicle.lidar, vehicle.outline)
            for name, mount in vehicle.lidar_mounts.items()
        }
        self._drawn: dict[str, object] = {}

    def show(self, timeline: Timeline, moment: Moment, hidden: AbstractSet[str]) -> None:
        """Draw a moment: only what has changed since the last one."""
        self._points(timeline, moment)
        if self._new("sonar", moment.sonar):
            self._canvas.lines(
                "/vehicle/sonar/echoes", _echoes(moment.sonar, self._parameters), INK, 2.0
            )
        if self._new("cells", moment.cells):
            self._draw_map(moment.cells)
        if self._new("path", moment.command):
            self._draw_path(moment)
        for name, groups in LAYERS.items():
            for group in groups:
                self._canvas.hide(group, name in hidden)

    def _new(self, name: str, what: object) -> bool:
        """Whether something else is to be drawn than before."""
        changed = name not in self._drawn or self._drawn[name] is not what
        self._drawn[name] = what
        return changed

    # ------------------------------------------------------------------ sensors

    def _points(self, timeline: Timeline, moment: Moment) -> None:
        for k, (name, color) in enumerate(zip(self._geometry, SCAN_COLORS, strict=False)):
            scan = moment.scans.get(name)
            if scan and moment.time_s - scan.time_ns * 1e-9 > OLD_S:
                scan = None
            if self._new(name, scan):
                points = self._hits(timeline, scan) if scan else np.zeros((0, 3))
                self._canvas.points(f"/lidar/{k}", points, color, 0.06)

    def _hits(self, timeline: Timeline, scan: LidarScan) -> Floats:
        """Where the beams ended, as seen from where the vehicle was then."""
        geometry, then = self._geometry[scan.sensor], timeline.at(scan.time_ns * 1e-9)
        pose = self._places.vehicle(then)
        hit = scan.range_m < LIDAR_NO_RETURN_M
        fan = (geometry.ray * scan.range_m)[:, hit]
        local = (geometry.mount[:, :2] @ fan).T + geometry.mount[:, 2]
        return pose.to_world(local) if pose else np.zeros((0, 3))

    # ------------------------------------------------------------------ map and path

    def _draw_map(self, cells: ObstacleCells | None) -> None:
        """Cells, and the boundaries around them as the planner expands them."""
        where = cells.position_m.reshape(-1, 2) if cells else np.zeros((0, 2))
        sure = cells.confidence[:, None] if cells else np.zeros((0, 1))
        colors = (sure * rgb(SEEN) + (1.0 - sure) * 255.0).astype(np.uint8)
        cell_m = self._parameters.obstacle_map.cell_m
        points = self._places.of_route(where, ABOVE_M["cells"])
        self._canvas.points("/map/cells", points, colors, 0.5 * cell_m)
        real, safe = boundary_edges(where, self._parameters)
        self._canvas.lines("/map/boundaries/real", self._raised(real), REAL, 2.5)
        self._canvas.lines("/map/boundaries/safe", self._raised(safe), SAFE, 2.0)

    def _raised(self, segment_m: Floats) -> Floats:
        """Segments (n, 2, 2) of route frame N on the ground, shape (n, 2, 3)."""
        flat = self._places.of_route(segment_m.reshape(-1, 2), ABOVE_M["boundary"])
        return flat.reshape(-1, 2, 3)

    def _draw_path(self, moment: Moment) -> None:
        command = moment.command
        points = command.pathpoint_m if isinstance(command, FollowPath) else np.zeros((0, 2))
        line = self._places.of_route(points, ABOVE_M["path"])
        selected = moment.decision and moment.decision.selected
        color = DECIDED if selected else TRACK
        self._canvas.points("/path/points", line, color, 0.14)
        self._canvas.lines("/path/line", segments(line), color, 3.0)

    def tracks(self, timeline: Timeline, time_s: float) -> None:
        """The trajectory so far; drawn anew every half second."""
        span = int(time_s * 10.0 / TRACK_EVERY)
        if self._drawn.get("tracks") != span:
            self._drawn["tracks"] = span
            true = timeline.true.between(0.0, time_s)[::TRACK_EVERY, 1:]
            believed = timeline.estimated.between(0.0, time_s)[::TRACK_EVERY, 1:3]
            raised = self._places.of_route(believed, ABOVE_M["track"])
            self._canvas.lines("/tracks/estimated", segments(raised), SEEN, 2.0)
            self._canvas.lines(
                "/tracks/true", segments(true + np.array([0.0, 0.0, 0.05])), TRACK, 3.0
            )


def boundary_edges(cell_m: Floats, parameters: Parameters) -> tuple[Floats, Floats]:
    """Edges of the real and of the safe boundary of reported cells.

    Args:
        cell_m: their centres, shape (n, 2), route frame N.
        parameters: the navigator's.

    Returns:
        Segments (k, 2, 2) of each, route frame N.
    """
    if not len(cell_m):
        return np.zeros((0, 2, 2)), np.zeros((0, 2, 2))
    size, foot = parameters.obstacle_map.cell_m, parameters.planning.footprint
    place = np.floor(cell_m / size).astype(np.int64)
    low = place.min(axis=0) - PAD
    count = int((place.max(axis=0) - low).max()) + 1 + PAD
    flat = (place[:, 1] - low[1]) * count + place[:, 0] - low[0]
    level = boundaries(flat, count, size, (foot.safe_radius_m, foot.real_radius_m))
    real, safe = (edges(level >= at, low * size, size) for at in (REAL_LEVEL, SAFE_LEVEL))
    return real, safe


def _echoes(scan: SonarScan | None, parameters: Parameters) -> Floats:
    """The cone of each sonar that hears something, up to its arc, shape (n, 2, 3)."""
    sonar, found = parameters.vehicle.sonar, []
    mounts = parameters.vehicle.sonar_mounts.values()
    ranges = scan.range_m.tolist() if scan else []
    for mount, range_m in zip(mounts, ranges, strict=False):
        if 0.0 < range_m < sonar.max_range_m - 1e-6:
            angle = mount.yaw_rad + np.linspace(-sonar.half_cone_rad, sonar.half_cone_rad, 5)
            rim = np.stack([np.cos(angle), np.sin(angle), np.zeros(5)], axis=1) * range_m
            around = np.concatenate([np.zeros((1, 3)), rim, np.zeros((1, 3))])
            found.append(segments(around + np.array(mount.position_m)))
    return np.concatenate(found) if found else np.zeros((0, 2, 3))
