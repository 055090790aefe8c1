"""Stretches of time in which something holds, told moment by moment."""

from typing import NamedTuple

APART_S = 1.0
"""What holds again so soon still holds."""


class Stretch(NamedTuple):
    """Of one device."""

    device: str
    from_s: float
    to_s: float
    why: str
    """As it was when it began."""


class Stretches:
    """Grows with how often something begins, and not with how long it lasts."""

    def __init__(self) -> None:
        self._done: list[Stretch] = []
        self._open: dict[str, Stretch] = {}

    def holds(self, time_s: float, device: str, why: str) -> None:
        """It holds now."""
        open_ = self._open.get(device)
        if open_ and time_s - open_.to_s <= APART_S:
            self._open[device] = open_._replace(to_s=time_s)
            return
        if open_:
            self._done.append(open_)
        self._open[device] = Stretch(device, time_s, time_s, why)

    def all(self) -> list[Stretch]:
        """In the order of their beginnings."""
        return sorted([*self._done, *self._open.values()], key=lambda s: (s.from_s, s.device))
