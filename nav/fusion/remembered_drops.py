"""Drops that lie outside the map, for a vehicle that drives back to them.

Rollback goes back farther than the map reaches. What stands up is seen again from there; an edge is
not, since a scanner sweeps over it once, some 18 m ahead (`negative_obstacles`).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.fusion.lattice import Lattice
from nav.messages import Floats


class Drops(NamedTuple):
    """Cells of drops: their centres in N, shape (2, n), and their confidence, (n,)."""

    position_m: Floats
    confidence: NDArray[np.float32]

    def with_more(self, more: "Drops") -> "Drops":
        """These and `more`."""
        position_m = np.concatenate([self.position_m, more.position_m], axis=1)
        return Drops(position_m, np.concatenate([self.confidence, more.confidence]))

    def outside(self, lattice: Lattice, reach_m: float) -> "Drops":
        """Those that lie outside `lattice`, but no farther than `reach_m` from its edge."""
        (west, south), size_m = lattice.origin_m, lattice.count * lattice.cell_m
        x, y = self.position_m[0] - west, self.position_m[1] - south
        beyond_m = np.maximum(np.maximum(-x, x - size_m), np.maximum(-y, y - size_m))
        keep = (beyond_m > 0.0) & (beyond_m <= reach_m)
        return Drops(self.position_m[:, keep], self.confidence[keep])


NO_DROPS = Drops(np.zeros((2, 0)), np.zeros(0, np.float32))
