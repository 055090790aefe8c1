"""Mutants that believe something wrong of the route: its place, its width, its limits."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from nav.high_level import HighLevelController
from nav.navigator import IonNavigator
from nav.route.waypoints import Waypoints
from scenarios.mutants.mutant import Mutant

DATUM_M = (0.0, 1.5)
"""East and north."""
FASTEST_MPS = 11.2
"""25 mph."""


def _elsewhere(waypoints: Waypoints) -> Waypoints:
    return replace(waypoints, position_m=waypoints.position_m + DATUM_M)


def _wider(waypoints: Waypoints) -> Waypoints:
    return replace(waypoints, half_width_m=2.0 * waypoints.half_width_m)


def _unlimited(waypoints: Waypoints) -> Waypoints:
    return replace(waypoints, speed_mps=np.full_like(waypoints.speed_mps, FASTEST_MPS))


_BELIEFS: dict[str, tuple[str, Callable[[Waypoints], Waypoints]]] = {
    "wrong_datum": ("The route is taken to lie 1.5 m north of where it is.", _elsewhere),
    "corridor_doubled": ("The corridor is taken for twice as wide as it is.", _wider),
    "limits_ignored": ("Every speed limit is taken for 25 mph.", _unlimited),
}


def _believes(change: Callable[[Waypoints], Waypoints], navigator: IonNavigator) -> IonNavigator:
    waypoints = change(navigator.high_level.waypoints)
    navigator.high_level = HighLevelController(navigator.parameters, waypoints)
    return navigator


BELIEVING = {name: Mutant(why, partial(_believes, how)) for name, (why, how) in _BELIEFS.items()}
"""By name."""
