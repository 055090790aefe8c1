"""Tunnel Mode: without GPS, sonars on both sides keep the vehicle in the centre (section 6.3)."""

from math import atan2, cos, sin

import numpy as np

from nav.angles import wrapped
from nav.messages import Floats, FollowPath
from nav.parameters import Parameters
from nav.parameters.states import TunnelParameters
from nav.planning.curve import Curve, sampled
from nav.planning.local_path import clear_distances, path_length, pathpoints
from nav.planning.speed import set_point
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation

NAME = "tunnel_mode"
SIDES = ("left_front", "right_front", "left_rear", "right_rear")
AHEAD_M = 20.0
Axis = tuple[float, float, float]
"""A point on the centre line, x and y, and its heading; frame N."""


def between_walls(s: Situation, p: TunnelParameters) -> bool:
    """Both front side sonars see a wall."""
    return _wall(s, "left_front", p) and _wall(s, "right_front", p)


def sides_open(s: Situation, p: TunnelParameters) -> bool:
    """No side sonar sees a wall."""
    return not any(_wall(s, name, p) for name in SIDES)


def _wall(s: Situation, name: str, p: TunnelParameters) -> bool:
    return 0.0 < s.sonar_m.get(name, np.inf) < p.wall_max_m


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """A straight path that comes back to the line between the walls."""
    memory.axis = _axis(s, memory, p)
    path = _to_axis(s, memory.axis)
    clear = clear_distances(path, s.boundaries, p.planning.footprint).touch_m
    memory.follow(pathpoints(path, path_length(s.ego.speed_mps, p.planning.local_path)), s.waypoint)
    assert memory.pathpoint_m is not None
    limit = min(s.V0_mps, p.states.tunnel.speed_mps)
    speed = set_point(clear, clear, 0.0, limit, "safe", p.speed).speed_mps
    command = FollowPath(s.time_ns, memory.pathpoint_m, speed)
    return Plan(command, speed, memory.axis[2], clear, clear, replanned="tunnel")


def _axis(s: Situation, memory: Memory, p: Parameters) -> Axis:
    """The centre line: moved towards each new measurement between two pairs of walls."""
    measured = _measured(s, p)
    if memory.axis is None:
        x, y = s.ego.position_m
        return measured or (float(x), float(y), s.ego.heading_rad)
    if measured is None:
        return memory.axis
    return _blended(memory.axis, measured, p.states.tunnel.axis_gain)


def _blended(axis: Axis, measured: Axis, gain: float) -> Axis:
    """The old axis turned and moved sideways by a share of the difference."""
    x, y, heading = axis
    c, sn = cos(heading), sin(heading)
    dx, dy = measured[0] - x, measured[1] - y
    along, across = c * dx + sn * dy, gain * (c * dy - sn * dx)
    turn = gain * wrapped(measured[2] - heading)
    return x + c * along - sn * across, y + sn * along + c * across, heading + turn


def _measured(s: Situation, p: Parameters) -> Axis | None:
    """Point and heading of the centre line from four side sonars, frame N."""
    if not all(_wall(s, name, p.states.tunnel) for name in SIDES):
        return None
    mounts = p.vehicle.sonar_mounts
    front, rear = (
        0.5 * (s.sonar_m[f"left_{end}"] - s.sonar_m[f"right_{end}"]) for end in ("front", "rear")
    )
    x_front, x_rear = mounts["left_front"].position_m[0], mounts["left_rear"].position_m[0]
    turn = atan2(front - rear, x_front - x_rear)
    c, sn = cos(s.ego.heading_rad), sin(s.ego.heading_rad)
    x, y = s.ego.position_m
    return (
        float(x) + c * x_front - sn * front,
        float(y) + sn * x_front + c * front,
        s.ego.heading_rad + turn,
    )


def _to_axis(s: Situation, axis: Axis) -> Curve:
    """From the vehicle onto the axis, the offset falling away over a few metres."""
    c, sn = cos(axis[2]), sin(axis[2])
    dx, dy = float(s.ego.position_m[0]) - axis[0], float(s.ego.position_m[1]) - axis[1]
    along, offset = c * dx + sn * dy, -sn * dx + c * dy
    arc: Floats = np.linspace(0.0, AHEAD_M, 41)
    left = offset * np.exp(-arc / 3.0)
    x = axis[0] + c * (along + arc) - sn * left
    y = axis[1] + sn * (along + arc) + c * left
    return sampled(np.stack([x, y], axis=1))
