"""Contacts: what the vehicle touched that it must not, merged within a second an object."""

from collections.abc import Sequence
from dataclasses import dataclass, field

MERGE_NS = 1_000_000_000
GROUND = "ground"
"""How a truth names the ground that the chassis touches."""


@dataclass
class Contacts:
    """Counts contacts of the vehicle with objects, and of its chassis with the ground."""

    soft: frozenset[str]
    """Owners of what a vehicle may touch."""
    count: int = 0
    grounded: int = 0
    objects: list[str] = field(default_factory=list)
    """Owners in the order of their first contact."""
    _last_ns: dict[str, int] = field(default_factory=dict)

    def observe(self, time_ns: int, owners: Sequence[str]) -> None:
        """Take the owners of the obstacles that the vehicle touches now."""
        for owner in owners:
            if owner not in self.soft:
                self._touch(time_ns, owner)

    def _touch(self, time_ns: int, owner: str) -> None:
        new = time_ns - self._last_ns.get(owner, -MERGE_NS - 1) > MERGE_NS
        self._last_ns[owner] = time_ns
        if owner == GROUND:
            self.grounded += new
            return
        self.count += new
        if owner not in self.objects:
            self.objects.append(owner)
