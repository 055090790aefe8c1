"""Road Following: along the road that the image-processing module sees (section 6.3)."""

from math import cos, sin

import numpy as np

from nav.messages import FollowPath, RoadEstimate
from nav.parameters import Parameters
from nav.planning.curve import Curve, sampled
from nav.planning.local_path import clear_distances, path_length, pathpoints
from nav.planning.speed import set_point
from nav.states.memory import Memory
from nav.states.situation import Plan, Situation

NAME = "road_following"


def plan(s: Situation, memory: Memory, p: Parameters) -> Plan:
    """Ten points in the middle of the road; a new path at every estimate."""
    assert s.road is not None
    path = road_ahead(s, s.road, p)
    clear = clear_distances(path, s.boundaries, p.planning.footprint).real_m
    distance = clear if clear < path.arc_m[-1] else p.planning.local_path.look_ahead_m
    length = path_length(s.ego.speed_mps, p.planning.local_path)
    memory.follow(pathpoints(path, length), s.waypoint)
    assert memory.pathpoint_m is not None
    speed = set_point(distance, distance, s.road.heading_rad, s.V0_mps, "safe", p.speed).speed_mps
    command = FollowPath(s.time_ns, memory.pathpoint_m, speed)
    direction = s.ego.heading_rad + s.road.heading_rad
    return Plan(command, speed, direction, distance, distance, replanned="road")


def road_ahead(s: Situation, road: RoadEstimate, p: Parameters) -> Curve:
    """From the vehicle onto the middle of the road, straight on."""
    x, y, vehicle = s.pose
    heading = vehicle + road.heading_rad
    arc = np.linspace(0.0, p.planning.local_path.look_ahead_m, 61)
    u = np.minimum(arc / p.states.road.join_m, 1.0)
    left = road.offset_m * (1.0 - 3.0 * u**2 + 2.0 * u**3) - road.offset_m
    c, sn = cos(heading), sin(heading)
    return sampled(np.stack([x + c * arc - sn * left, y + sn * arc + c * left], axis=1))
