"""When a new local path is due: the left half of Fig. 6.4."""

from functools import lru_cache

from nav.messages import Floats
from nav.parameters import Parameters
from nav.parameters.planning import Footprint
from nav.planning.curve import Curve, nearest_index
from nav.planning.local_path import FIFTH, Clear, clear_distances
from nav.states.memory import Memory
from nav.states.situation import Situation


def due(s: Situation, memory: Memory, p: Parameters) -> str:
    """Why the local path must be made anew, or empty."""
    if memory.curve is None or memory.pathpoint_m is None:
        return "new state"
    if s.waypoint != memory.waypoint:
        return "waypoint passed"
    here = _index(memory.curve, s.ego.position_m)
    if here >= _index(memory.curve, memory.pathpoint_m[FIFTH]):
        return "fifth pathpoint reached"
    clear = _clear(s, memory.curve, p.planning.footprint)
    return "path crosses an obstacle" if clear.real_m < clear.arc_m[-1] else ""


def distance_ahead(s: Situation, memory: Memory, beyond_m: float, p: Parameters) -> float:
    """D1: distance along the local path in force before the outline would touch, [m].

    Where the path is free to its end, `beyond_m` says how far the way is free.
    """
    if memory.curve is None:
        return beyond_m
    clear = _clear(s, memory.curve, p.planning.footprint)
    touch_m = clear.touch_m
    return touch_m if touch_m < clear.arc_m[-1] else beyond_m


@lru_cache(maxsize=1)
def _clear(s: Situation, path: Curve, footprint: Footprint) -> Clear:
    """How far the rest of a path is free; asked for twice where it stays in force."""
    rest = _rest(path, _index(path, s.ego.position_m))
    return clear_distances(rest, s.boundaries, footprint)


def _index(curve: Curve, point_m: Floats) -> int:
    return nearest_index(curve, *point_m.tolist())


def _rest(curve: Curve, index: int) -> Curve:
    i = min(index, len(curve.arc_m) - 2)
    arc = curve.arc_m[i:] - curve.arc_m[i]
    return Curve(curve.position_m[i:], curve.heading_rad[i:], curve.curvature_per_m[i:], arc)
