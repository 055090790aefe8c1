"""One set of robotic unit operations: looked for, then driven one after the other."""

from dataclasses import dataclass, field
from math import hypot

from nav.planning.arcs import Pose
from nav.planning.unit_operations import Arc, Search, merged

DONE_M = 0.1
"""An operation ends this near to its length."""


@dataclass
class Manoeuvre:
    """Knows which operation is under way, and how far it has come."""

    search: Search
    arcs: tuple[Arc, ...] = ()
    index: int = 0
    driven_m: float = 0.0
    cut_short: bool = False
    """Something new was in the way: what was planned holds no more."""
    _last: Pose = field(default=(0.0, 0.0, 0.0))

    @property
    def arc(self) -> Arc | None:
        """The operation under way; None before and behind all."""
        return self.arcs[self.index] if self.index < len(self.arcs) else None

    @property
    def done(self) -> bool:
        """Whether all that was planned has been driven."""
        return self.search.found is not None and self.arc is None

    def think(self, pose: Pose) -> None:
        """Look for operations a little further."""
        self.search.advance()
        if self.search.found is not None:
            self.arcs, self._last = merged(self.search.found), pose

    def remaining_m(self, pose: Pose) -> float:
        """Way that is left of the operation under way."""
        self.driven_m += hypot(pose[0] - self._last[0], pose[1] - self._last[1])
        self._last = pose
        return max(self.arc.length_m - self.driven_m, 0.0) if self.arc else 0.0

    def next(self) -> None:
        """The operation under way is over."""
        self.index, self.driven_m = self.index + 1, 0.0
