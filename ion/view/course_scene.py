"""What does not move: ground, corridor, obstacles, gates, and the smooth path of the route."""

from collections.abc import Sequence

import numpy as np
import viser

from ion.style import AHEAD, EDGE, HARD, MISSED, PASSED, QUIET, TUNNEL
from ion.view.canvas import lines
from ion.view.ground import Mesh, coarse, fine
from ion.view.places import Places
from ion.view.shapes import box, cylinder, rgb, segments
from nav.messages import Floats
from scenarios.course import Course
from scenarios.verdicts.tracking import route_path
from twin.world import SOFT, Obstacle

CORRIDOR, GROUND, FAR_GROUND = "#c2a878", "#8f8a68", "#857f60"
KINDS = {
    "tunnel": TUNNEL, "car": "#5b6f8c", "hay_bale": "#c59b3c", "tires": "#3d3b38",
    "gate_post": PASSED, "gate_flank": "#c96f3b", **dict.fromkeys(sorted(SOFT), EDGE),
}  # fmt: skip
"""Colours; what is not named is grey as on the map."""
EDGE_STEP_M = 2.0
ABOVE_M = 0.08


def draw_course(scene: viser.SceneApi, course: Course, places: Places) -> None:
    """Draw all of it."""
    line_m = course.waypoint_m
    _mesh(scene, "/ground/far", coarse(places, line_m), FAR_GROUND)
    inside, beside = fine(places, line_m, course.half_width_m)
    _mesh(scene, "/ground/corridor", inside, CORRIDOR)
    _mesh(scene, "/ground/beside", beside, GROUND)
    _draw_edges(scene, course, places)
    path = places.of_route(route_path(course).position_m, ABOVE_M)
    lines(scene, "/route/smooth_path", segments(path), QUIET, 2.0)
    draw_obstacles(scene, course.world.everything())


def draw_gates(
    scene: viser.SceneApi, course: Course, places: Places, passed: set[int], missed: set[int]
) -> None:
    """A line from post to post: ahead, passed or missed."""
    ends = [end for gate in course.gates for end in (gate.left_m, gate.right_m)]
    if not ends:
        return
    gate_m = places.on_ground(np.array(ends), ABOVE_M).reshape(-1, 2, 3)
    ahead = set(range(len(gate_m))) - passed - missed
    for name, among, color in (
        ("passed", passed, PASSED), ("missed", missed, MISSED), ("ahead", ahead, AHEAD),
    ):  # fmt: skip
        if among:
            lines(scene, f"/gates/{name}", gate_m[sorted(among)], color, 5.0)
        else:
            scene.remove_by_name(f"/gates/{name}")


def draw_obstacles(scene: viser.SceneApi, obstacles: Sequence[Obstacle]) -> None:
    """One batch of boxes and one of cylinders."""
    for shape, mesh in (("box", box()), ("cylinder", cylinder())):
        among = [obstacle for obstacle in obstacles if obstacle.shape == shape]
        if among:
            _batch(scene, f"/obstacles/{shape}", mesh, among)


def _batch(scene: viser.SceneApi, name: str, mesh: Mesh, among: list[Obstacle]) -> None:
    scene.add_batched_meshes_simple(
        name,
        mesh.vertex_m,
        mesh.face,
        batched_wxyzs=np.array([o.quat for o in among]),
        batched_positions=np.array([o.center_m for o in among]),
        batched_scales=np.array([_scale(o) for o in among]),
        batched_colors=np.array([rgb(KINDS.get(o.kind, HARD)) for o in among], np.uint8),
        flat_shading=True,
        lod="off",
        cast_shadow=False,
        receive_shadow=False,
    )


def _scale(obstacle: Obstacle) -> tuple[float, float, float]:
    x, y, z = obstacle.half_size_m
    return (x, x, z) if obstacle.shape == "cylinder" else (x, y, z)


def _mesh(scene: viser.SceneApi, name: str, mesh: Mesh, color: str) -> None:
    scene.add_mesh_simple(
        name, mesh.vertex_m, mesh.face, color=rgb(color), cast_shadow=False, receive_shadow=False
    )


def _draw_edges(scene: viser.SceneApi, course: Course, places: Places) -> None:
    """Both edges of each segment's rectangle, cut into pieces that follow the ground."""
    pieces: list[Floats] = []
    line, width = course.waypoint_m, course.half_width_m
    for start, end, half in zip(line[:-1], line[1:], width, strict=False):
        length = float(np.hypot(*(end - start)))
        if length > 0.0:
            along = np.linspace(start, end, max(2, int(length / EDGE_STEP_M) + 1))
            normal = np.array([start[1] - end[1], end[0] - start[0]]) * half / length
            sides = (along + normal, along - normal)
            pieces += [segments(places.on_ground(side, ABOVE_M)) for side in sides]
    lines(scene, "/route/corridor", np.concatenate(pieces), "#a58f5a", 1.5)
