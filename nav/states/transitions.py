"""Who may follow whom in Fig. 6.3, and why: the guards, in the order in which they are asked.

A guard says why its transition is due, or nothing. Its name stands in the diagram of the machine.
"""

from collections.abc import Callable

import numpy as np

from nav.angles import wrapped
from nav.parameters import Parameters
from nav.planning.detour import target
from nav.planning.local_path import clear_distances
from nav.planning.unit_operations import exit_is_free, exits
from nav.states import (
    alarm,
    obstacle_avoidance,
    path_point_keeping,
    road_following,
    robotic_operations,
    rollback,
    tunnel_mode,
)
from nav.states.memory import Memory
from nav.states.situation import Situation

JOIN_RAD = 0.5
"""The smooth path is joined from a heading within this."""
Guard = Callable[[Situation, Memory, Parameters], str]


# ---------------------------------------------------------------- between the two main states


def obstacle_ahead(s: Situation, memory: Memory, p: Parameters) -> str:
    """The smooth path comes across an obstacle (section 6.4.2)."""
    if memory.trouble.arc_m is not None:
        return "on a way around"
    if s.route_clear.real_m < s.route_ahead.arc_m[-1]:
        return f"obstacle on the smooth path in {s.route_clear.real_m:.0f} m"
    return _cannot_join(s, p)


def _cannot_join(s: Situation, p: Parameters) -> str:
    """Beyond the paper: from far beside the route, or across it, no smooth path leads back that
    the steering could follow, so that being free is no merit of it."""
    if abs(s.cross_track_m) < p.planning.local_path.join_offset_m:
        return ""
    if s.route_ahead.arc_m[-1] < abs(s.cross_track_m):
        return "smooth path ends before it is joined"
    turn = abs(wrapped(float(s.route_ahead.heading_rad[0]) - s.ego.heading_rad))
    tightest = float(np.abs(s.route_ahead.curvature_per_m).max())
    too_tight = tightest * p.vehicle.steering.minimum_radius_m > 1.0
    return "smooth path cannot be joined" if too_tight or turn > JOIN_RAD else ""


def route_clear(s: Situation, memory: Memory, p: Parameters) -> str:
    """The smooth path is free again."""
    return "" if obstacle_ahead(s, memory, p) else "smooth path is clear"


# ---------------------------------------------------------------- the tunnel


def in_tunnel(s: Situation, memory: Memory, p: Parameters) -> str:
    """GPS is gone and there is a wall on either side; never GPS alone."""
    del memory
    lost = s.gps_lost_s > p.states.tunnel.gps_lost_s
    walls = tunnel_mode.between_walls(s, p.states.tunnel)
    return "no GPS between two walls" if lost and walls else ""


def out_of_tunnel(s: Situation, memory: Memory, p: Parameters) -> str:
    """The walls have ended."""
    if not tunnel_mode.sides_open(s, p.states.tunnel):
        memory.open_ns = None
        return ""
    if memory.open_ns is None:
        memory.open_ns = s.time_ns
    if s.gps_lost_s < p.states.tunnel.gps_back_s:
        return "walls ended, GPS is back"
    open_s = (s.time_ns - memory.open_ns) * 1e-9
    return "walls ended" if open_s > p.states.tunnel.leave_open_s else ""


# ---------------------------------------------------------------- sensor failures


def sensor_failed(s: Situation, memory: Memory, p: Parameters) -> str:
    """A sensor has failed that should speak, and speak the truth."""
    del memory, p
    if s.health.failed:
        return f"{' and '.join(s.health.failed)} failed"
    return f"without {s.health.unfit}" if s.health.unfit else ""


def sensor_recovered(s: Situation, memory: Memory, p: Parameters) -> str:
    """All sensors speak again."""
    del memory, p
    return "" if s.health.failed or s.health.lost else "sensors speak again"


def sensor_lost(s: Situation, memory: Memory, p: Parameters) -> str:
    """What has failed is given up: the flag lowers the speed limit. Some it cannot do without."""
    del memory, p
    stays = s.health.failed or s.health.unfit
    return "" if stays else f"without {' and '.join(s.health.lost)}"


# ---------------------------------------------------------------- the road


def road_seen(s: Situation, memory: Memory, p: Parameters) -> str:
    """The image-processing module is sure of a road, and the corridor leaves the choice."""
    del memory
    road = p.states.road
    if s.road is None or s.half_width_m < road.wide_m:
        return ""
    sure = s.road.confidence >= road.enter_confidence and _on_road(s, p)
    return f"road of {s.road.width_m:.1f} m seen" if sure else ""


def road_lost(s: Situation, memory: Memory, p: Parameters) -> str:
    """The road is not seen any more, or the corridor has become narrow."""
    del memory
    road = p.states.road
    if s.road is None or s.road.confidence < road.leave_confidence:
        return "road is lost"
    return "corridor is narrow" if s.half_width_m < road.wide_m else ""


def obstacle_on_road(s: Situation, memory: Memory, p: Parameters) -> str:
    """The way along the road comes across an obstacle."""
    del memory
    return "" if _on_road(s, p) else "obstacle on the road"


def _on_road(s: Situation, p: Parameters) -> bool:
    assert s.road is not None
    path = road_following.road_ahead(s, s.road, p)
    clear = clear_distances(path, s.boundaries, p.planning.footprint).real_m
    return clear >= path.arc_m[-1]


# ---------------------------------------------------------------- stuck


def dangerously_close(s: Situation, memory: Memory, p: Parameters) -> str:
    """Stopped by the rules, too near to an obstacle for anything but driving back."""
    near = memory.trouble.ahead_m < p.states.rollback.close_m
    stuck = _stopped(memory, p) and near and rollback.way_back_m(s, memory, p) > 0.0
    return f"stopped {memory.trouble.ahead_m:.1f} m before an obstacle" if stuck else ""


def no_forward_path(s: Situation, memory: Memory, p: Parameters) -> str:
    """Stopped by the rules: a direct forward path would contact obstacles. Or the goal has lain
    behind for a while."""
    del s
    trouble, stuck = memory.trouble, p.states.stuck
    if trouble.tries >= stuck.tries:
        return ""
    if _stopped(memory, p):
        return "no forward path is free"
    return "the goal lies behind" if trouble.behind_s > stuck.behind_s else ""


def room_again(s: Situation, memory: Memory, p: Parameters) -> str:
    """Far enough from the obstacle for robotic operations, or as far as it can go."""
    rolled = rollback.rolled_m(s, memory)
    enough = rolled >= p.states.rollback.back_off_m and not memory.trouble.rolls_far
    return f"{rolled:.1f} m back" if enough or rollback.way_back_m(s, memory, p) <= 0.0 else ""


def another_path(s: Situation, memory: Memory, p: Parameters) -> str:
    """Where it is now, another path can begin."""
    memory.trouble.look(s, p.states.stuck)
    way = memory.trouble.way
    if not way or rollback.rolled_m(s, memory) < p.states.rollback.back_off_m:
        return ""
    fan, goal = exits(p), target(way, s.pose[:2], p.planning.operations.exit_m)
    free = exit_is_free(fan, s.pose, goal, s.boundaries, p.planning)
    return "another path begins" if free else ""


def operations_done(s: Situation, memory: Memory, p: Parameters) -> str:
    """All unit operations are driven: forward is free. Or there are none, and no way back."""
    if memory.manoeuvre is None:
        return ""
    if memory.manoeuvre.done:
        return "unit operations done"
    cornered = memory.manoeuvre.search.exhausted and rollback.way_back_m(s, memory, p) <= 0.0
    return "no unit operations, and no way back" if cornered else ""


def no_operations(s: Situation, memory: Memory, p: Parameters) -> str:
    """No operations lead out of here: back along the trajectory till another path can begin."""
    again = memory.trouble.tries > p.states.stuck.same_tries
    found = not (memory.manoeuvre and memory.manoeuvre.search.exhausted)
    if (found and not again) or rollback.way_back_m(s, memory, p) <= 0.0:
        return ""
    memory.trouble.rolls_far = True
    return "unit operations lead back here" if found else "no unit operations lead out"


def _stopped(memory: Memory, p: Parameters) -> bool:
    return memory.trouble.stopped_s > p.states.stuck.stand_s


TRANSITIONS: dict[str, tuple[tuple[str, Guard], ...]] = {
    path_point_keeping.NAME: (
        (tunnel_mode.NAME, in_tunnel),
        (alarm.NAME, sensor_failed),
        (obstacle_avoidance.NAME, obstacle_ahead),
        (road_following.NAME, road_seen),
    ),
    obstacle_avoidance.NAME: (
        (tunnel_mode.NAME, in_tunnel),
        (alarm.NAME, sensor_failed),
        (path_point_keeping.NAME, route_clear),
        (rollback.NAME, dangerously_close),
        (robotic_operations.NAME, no_forward_path),
    ),
    tunnel_mode.NAME: ((path_point_keeping.NAME, out_of_tunnel),),
    alarm.NAME: (
        (path_point_keeping.NAME, sensor_recovered),
        (path_point_keeping.NAME, sensor_lost),
    ),
    road_following.NAME: (
        (alarm.NAME, sensor_failed),
        (path_point_keeping.NAME, road_lost),
        (obstacle_avoidance.NAME, obstacle_on_road),
    ),
    rollback.NAME: (
        (obstacle_avoidance.NAME, another_path),
        (robotic_operations.NAME, room_again),
    ),
    robotic_operations.NAME: (
        (obstacle_avoidance.NAME, operations_done),
        (rollback.NAME, no_operations),
    ),
}
"""For each state the states that may follow it."""
