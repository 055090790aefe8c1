"""What beams meet: what is solid, and what they can pass: brush, and phantoms of one scanner."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from twin.raycast import Scene, hide
from twin.sensors.sensor import Floats, Ints
from twin.world import OPACITY, SILENT, Obstacle, World


class Rays(NamedTuple):
    """As `cast_hits` takes them."""

    origins: Floats
    """Shape (m, 3)."""
    directions: Floats
    """Shape (n, 3)."""
    rotations: Floats
    """Shape (m, 3, 3)."""


class Veil:
    """A scene of its own, looked at after what is solid."""

    def __init__(self, things: Sequence[Obstacle]) -> None:
        self._things = things
        self.scene = Scene(things)
        self._opacities: dict[str, Floats] = {}

    def hide(
        self, range_m: Floats, rays: Rays, max_range_m: float, sensor: str, drawn: Floats
    ) -> None:
        """Shorten ranges as `cast_hits` gave them where a beam is held back.

        Args:
            range_m: shape (m, n), [m]; written into.
            rays: from where, and where to.
            max_range_m: farther away nothing is met.
            sensor: whose beams they are.
            drawn: shape (m, n), within [0, 1): a beam is held where it is less than the thing's
                opacity.
        """
        opacity = self._opacities.get(sensor)
        if opacity is None:
            opacity = self._opacities[sensor] = self._opacity(sensor)
        hide(self.scene, *rays[:2], max_range_m, rays.rotations, opacity, drawn, range_m)

    def _opacity(self, sensor: str) -> Floats:
        """The share of a sensor's beams that each thing holds back, shape (n,)."""
        seen = [
            o.seen_by in ("", sensor) and not (sensor == "sonar" and o.kind in SILENT)
            for o in self._things
        ]
        return np.array([OPACITY[o.kind] for o in self._things]) * seen


class Sight:
    """All that beams can meet. Things and ground are replaced as the vehicle moves."""

    def __init__(self, world: World) -> None:
        self.solid = Scene(())
        self._shown: Sequence[Obstacle] | None = None
        self.show(world.obstacles)

    def show(self, obstacles: Sequence[Obstacle]) -> None:
        """Replace the things; `set_ground` must follow before the next ray."""
        if obstacles is self._shown:
            return
        self._shown = obstacles
        self.things = tuple(o for o in obstacles if o.kind not in OPACITY)
        """What is solid, as `cast_hits` numbers it."""
        self.solid.set_solids(self.things)
        veiling = tuple(o for o in obstacles if o.kind in OPACITY)
        self.veil = Veil(veiling) if veiling else None
        """None where everything is solid."""

    def set_ground(self, z: Floats, x0: float, y0: float, spacing: float) -> None:
        """See `Scene.set_ground`."""
        self.solid.set_ground(z, x0, y0, spacing)
        if self.veil:
            self.veil.scene.set_ground(z, x0, y0, spacing)


@dataclass
class ByKind:
    """A value for each thing in sight, by its kind; and for the ground, and where nothing is."""

    sight: Sight
    values: Mapping[str, Any]
    other: Any
    """Of kinds that `values` leaves out."""
    ground: Any
    nothing: Any
    _things: tuple[Obstacle, ...] | None = None
    _value: NDArray[Any] = field(default_factory=lambda: np.empty(0))

    def of(self, what: Ints) -> NDArray[Any]:
        """The values of what `cast_hits` says was hit, any shape."""
        return self.values_by_number()[what]

    def values_by_number(self) -> NDArray[Any]:
        """To be indexed by what `cast_hits` says was hit."""
        if self._things is not self.sight.things:
            self._things = self.sight.things
            known = [self.values.get(thing.kind, self.other) for thing in self._things]
            # NO_HIT and GROUND are negative: they count from the end
            self._value = np.array([*known, self.nothing, self.ground])
        return self._value
