"""Mutants with wrong parameters: numbers that a file could say, and no test refuses."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from math import inf
from typing import Any

from nav.control.low_level import LowLevelController
from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.plausibility import Plausibility
from nav.high_level import HighLevelController
from nav.navigator import IonNavigator
from nav.parameters import Parameters
from scenarios.mutants.mutant import Mutant

NEVER = 1_000_000

_VALUES: dict[str, tuple[str, dict[str, Any]]] = {
    "watchdog_off": (
        "The watchdog never bites.",
        {"states.watchdog.still_s": inf, "states.watchdog.outside_s": inf},
    ),
    "watchdog_eager": (
        "The watchdog bites after two seconds, and heeds no obstacle.",
        {"states.watchdog.still_s": 2.0, "states.watchdog.override": "paper"},
    ),
    "watchdog_blind": (
        "The watchdog drives on, whatever stands there.",
        {"states.watchdog.override": "paper"},
    ),
    "alarm_endless": (
        "No sensor is ever given up: Alarm lasts until it speaks again.",
        {"states.health.patience_s": inf, "states.health.often": NEVER},
    ),
    "alarm_hasty": (
        "A sensor that fails is given up at once.",
        {"states.health.patience_s": 0.0},
    ),
    "look_ahead_halved": (
        "The route and the directions are looked at half as far.",
        {"planning.local_path.look_ahead_m": 15.0, "planning.scanning.max_distance_m": 15.0},
    ),
    "believes_itself_thin": (
        "The vehicle is taken for half as wide as it is.",
        {
            "planning.footprint.touch_radius_m": 0.45,
            "planning.footprint.real_radius_m": 0.6,
            "planning.footprint.safe_radius_m": 0.8,
            "planning.footprint.corridor_touch_m": 0.3,
            "planning.footprint.corridor_real_m": 0.45,
            "planning.footprint.corridor_safe_m": 0.6,
        },
    ),
    "bends_at_full_speed": (
        "Bends do not lower the speed.",
        {"planning.speed.lateral_mps2": 50.0},
    ),
    "nervous_path_follower": (
        "An offset from the path is to decay within half a metre.",
        {"control.path.length_m": 0.5, "control.path.length_s": 0.05},
    ),
    "antenna_mirrored": (
        "The GPS antenna is taken to sit behind the rear axles, not before them.",
        {"vehicle.gps_position_m": (-0.6, 0.0, 1.98)},
    ),
    "no_drops": (
        "Drops are not looked for.",
        {"obstacle_map.negative.enabled": False},
    ),
    "unforgetting_map": (
        "What is once in the map stays there.",
        {
            "obstacle_map.confidence.clear_ps": 1e-9,
            "obstacle_map.confidence.fade_ps": 1e-9,
            "obstacle_map.negative.clear": 1e-9,
        },
    ),
}


def with_value(whole: Any, path: str, value: Any) -> Any:
    """Frozen dataclasses with another value at `path`, such as `states.watchdog.still_s`."""
    name, _, rest = path.partition(".")
    inner = with_value(getattr(whole, name), rest, value) if rest else value
    return replace(whole, **{name: inner})


def rebuilt(navigator: IonNavigator, p: Parameters) -> IonNavigator:
    """As if it had been built with these parameters; the ego filter keeps its own."""
    navigator.retune(p)
    navigator.ego.vehicle = p.vehicle
    navigator.obstacles = ObstacleMap(p.obstacle_map, p.vehicle)
    navigator.plausibility = Plausibility(p.plausibility, p.vehicle.lidar_mounts)
    navigator.high_level = HighLevelController(p, navigator.high_level.waypoints)
    navigator.low_level = LowLevelController(p.control, p.vehicle.steering)
    return navigator


def _with_values(values: Mapping[str, Any], navigator: IonNavigator) -> IonNavigator:
    parameters = navigator.parameters
    for path, value in values.items():
        parameters = with_value(parameters, path, value)
    return rebuilt(navigator, parameters)


VALUES = {name: Mutant(why, partial(_with_values, to)) for name, (why, to) in _VALUES.items()}
"""By name."""
