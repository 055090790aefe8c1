"""Mutants with a wrong obstacle map."""

from collections.abc import Sequence
from functools import partial

from nav.fusion.lattice import Ints
from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.radar import Echoes
from nav.fusion.scan_geometry import Sweep
from nav.navigator import IonNavigator
from scenarios.mutants.mutant import Mutant, remade

FREEZES_NS = 10_000_000_000
SHIFT_CELLS = 5
"""A metre."""


class FrozenMap(ObstacleMap):
    """Scans that are younger than ten seconds are left out."""

    def integrate(self, sweeps: Sequence[Sweep], echoes: Echoes | None = None) -> None:
        """Take in the scans of the first seconds."""
        super().integrate([s for s in sweeps if s.scan.time_ns < FREEZES_NS], echoes)


class ForgetfulMap(ObstacleMap):
    """Knows what it sees just now."""

    def integrate(self, sweeps: Sequence[Sweep], echoes: Echoes | None = None) -> None:
        """Forget all, then take in the scans of one tick."""
        self.grid[:] = 0.0
        super().integrate(sweeps, echoes)


class ShiftedMap(ObstacleMap):
    """Says that everything stands a metre farther north."""

    def occupied_index(self) -> Ints:
        """Where the cells are said to be, flat, shape (n,)."""
        north = super().occupied_index() + SHIFT_CELLS * self.lattice.count
        return north[north < self.lattice.count**2]


_MAPS: dict[str, tuple[str, type[ObstacleMap]]] = {
    "frozen_map": ("After ten seconds scans do not enter the map.", FrozenMap),
    "forgetful_map": ("The map forgets at once what is not seen.", ForgetfulMap),
    "shifted_map": ("What is in the map is read a metre too far north.", ShiftedMap),
}


def _remembers(kind: type[ObstacleMap], navigator: IonNavigator) -> IonNavigator:
    navigator.obstacles = remade(kind, navigator.obstacles)
    return navigator


REMEMBERING = {name: Mutant(why, partial(_remembers, kind)) for name, (why, kind) in _MAPS.items()}
"""By name."""
