"""What beams meet: what is solid, and what they can pass: brush, and phantoms of one scanner."""

from typing import NamedTuple

import numpy as np

from twin.raycast import Scene, cast_hits
from twin.sensors.sensor import Floats
from twin.world import OPACITY, SILENT, World


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

    def __init__(self, world: World) -> None:
        self._things = [o for o in world.obstacles if o.kind in OPACITY]
        self.scene = Scene(self._things)

    def hide(
        self, range_m: Floats, rays: Rays, max_range_m: float, sensor: str, drawn: Floats | float
    ) -> Floats:
        """Ranges as `cast_hits` gave them, shorter where a beam is held back.

        Args:
            range_m: shape (m, n), [m].
            rays: from where, and where to.
            max_range_m: farther away nothing is met.
            sensor: whose beams they are.
            drawn: shape (m, n) or one number, within [0, 1): a beam is held where it is less than
                the thing's opacity.
        """
        veiled_m, what = cast_hits(self.scene, *rays[:2], max_range_m, rays.rotations)
        opacity = self._opacity(sensor)[np.maximum(what, 0)]
        held = (what >= 0) & (veiled_m < range_m) & (drawn < opacity)
        return np.where(held, veiled_m, range_m)

    def _opacity(self, sensor: str) -> Floats:
        """The share of a sensor's beams that each thing holds back, shape (n,)."""
        seen = [
            o.seen_by in ("", sensor) and not (sensor == "sonar" and o.kind in SILENT)
            for o in self._things
        ]
        return np.array([OPACITY[o.kind] for o in self._things]) * seen


class Sight:
    """All that beams can meet. The ground is replaced as the vehicle moves."""

    def __init__(self, world: World) -> None:
        self.things = [o for o in world.obstacles if o.kind not in OPACITY]
        """What is solid, as `cast_hits` numbers it."""
        self.solid = Scene(self.things)
        hides = any(o.kind in OPACITY for o in world.obstacles)
        self.veil = Veil(world) if hides else None
        """None where everything is solid."""

    def set_ground(self, z: Floats, x0: float, y0: float, spacing: float) -> None:
        """See `Scene.set_ground`."""
        self.solid.set_ground(z, x0, y0, spacing)
        if self.veil:
            self.veil.scene.set_ground(z, x0, y0, spacing)
