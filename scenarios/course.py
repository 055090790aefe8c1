"""A course: all that an episode, a judge and a picture need to know about one drawn world."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.parameters import ION
from nav.route.rddf import FOOT_M as FOOT_M
from nav.route.rddf import MPH_MPS as MPH_MPS
from nav.route.rddf import Route
from twin.earth import to_world
from twin.world import World

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Gate:
    """A gate's free opening: from the inner face of one post to that of the other."""

    left_m: Floats
    """Shape (2,), world frame, [m], on the left of who passes it forwards."""
    right_m: Floats
    """Shape (2,), world frame, [m]."""


class Patience(NamedTuple):
    """How long the judge looks at a vehicle that stays in one place."""

    seconds: float = 240.0
    metres: float = 1.0
    """Farther away is another place."""
    word: str = "stuck"
    """The outcome, once patience has ended."""


@dataclass(frozen=True, eq=False)
class Course:
    """One course as one seed drew it. It holds exactly what is to be driven: of a longer route
    file only the stretch. Points are in the world frame, [m]."""

    name: str
    title: str
    seed: int
    world: World
    route_text: str
    """The route definition file (RDDF) that the navigator is given."""
    route_name: str
    """What messages call that file."""
    waypoint_m: Floats
    """Shape (n, 2)."""
    half_width_m: Floats
    """Shape (n,): the corridor's half-width from each waypoint to the next."""
    speed_mps: Floats
    """Shape (n,): the speed limit from each waypoint to the next."""
    time_limit_s: float
    gates: tuple[Gate, ...] = ()
    """In driving order."""
    tunnel_center_line_m: Floats | None = None
    """Shape (k, 2), in driving order, or None where there is no tunnel."""
    vehicle: str = ION
    """A name of `scenarios.vehicles`."""
    goal_m: float | None = None
    """Finished when the reference point is this near to the last waypoint; None: when the nose
    crosses the line there."""
    patience: Patience = field(default_factory=Patience)
    facts: Mapping[str, Any] = field(default_factory=dict)
    """What the scenario says of this draw, for the figures."""


def route_points_m(route: Route, anchor: tuple[float, float]) -> Floats:
    """The route's waypoints in the world frame that is anchored at `anchor` [deg], shape (n, 2)."""
    return np.stack(to_world(anchor, route.latitude_deg, route.longitude_deg), axis=1)
