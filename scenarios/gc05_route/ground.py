"""The desert: hills that the route leads over, and bumps that come and go by the mile."""

from dataclasses import dataclass

import numpy as np

from twin.landforms import Landform
from twin.terrain import Octave, RollingGround
from twin.world import Floats

HILLS = (Octave(1800.0, 24.0), Octave(420.0, 4.0), Octave(160.0, 1.4))
"""Estimated: slopes of some 8 %."""
BUMPS = (Octave(32.0, 0.18), Octave(6.0, 0.024), Octave(2.6, 0.008))
"""Estimated: what is left of washboard and ruts on a lattice of half a metre."""
COUNTRY = (Octave(2900.0, 0.8),)
"""Where it is rough, and where it is smooth as a dry lake."""
LEAST, MOST = 0.1, 1.5
"""Of the bumps."""


@dataclass(frozen=True)
class Bumps:
    """A landform: bumps, more of them here and fewer there."""

    seed: int

    def height(self, x: Floats, y: Floats) -> Floats:
        """See `Landform`."""
        rough = 0.7 + RollingGround(self.seed + 1, COUNTRY).height(x, y)
        return np.clip(rough, LEAST, MOST) * RollingGround(self.seed + 2, BUMPS).height(x, y)


def ground(seed: int, forms: tuple[Landform, ...] = ()) -> RollingGround:
    """As `seed` draws it."""
    return RollingGround(seed, HILLS, (Bumps(seed), *forms))
