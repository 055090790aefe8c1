"""What the rest of a drive would have been, had the fuzzy controllers been tuned otherwise.

The drive is driven again from its start, and remembered every few seconds; from the memory before a
moment it goes on, with other terms. With the same ones it is, bit for bit, the drive that was.
"""

import pickle
import zlib
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

from nav.parameters.fuzzy import SpeedParameters, SteeringParameters
from scenarios.episode import Episode

EVERY_S = 10.0
"""From one remembered moment to the next."""
REPORT_TICKS = 5
"""Ticks between two reports: 10 Hz."""
Passed = Callable[[float], None]
"""Is told how far a drive has got, [s], after each tick; may raise to end it."""


class Snapshots:
    """A drive at several of its moments, packed: a tenth of a megabyte each.

    Args:
        begin: makes the episode at its start.
    """

    def __init__(self, begin: Callable[[], Episode]) -> None:
        self._begin = begin
        self._time_s: list[float] = []
        self._packed: list[bytes] = []

    def at(self, time_s: float, passed: Passed = lambda _: None) -> Episode:
        """The episode as it was at a time, or as it ended before: a copy to go on with."""
        episode = self._before(time_s)
        while episode.outcome is None and episode.time_s < time_s - 1e-9:
            self._remember(episode)
            episode.tick()
            passed(episode.time_s)
        return episode

    def _before(self, time_s: float) -> Episode:
        k = bisect_right(self._time_s, time_s + 1e-9)
        return pickle.loads(zlib.decompress(self._packed[k - 1])) if k else self._begin()

    def _remember(self, episode: Episode) -> None:
        last_s = self._time_s[-1] if self._time_s else -EVERY_S
        if episode.time_s >= last_s + EVERY_S - 1e-9:
            self._packed.append(zlib.compress(pickle.dumps(episode), 1))
            self._time_s.append(episode.time_s)


class Progress(NamedTuple):
    """A drive that goes on, a tenth of a second later each time."""

    time_s: float
    position_m: tuple[float, float, float]
    """The true one, world frame."""
    speed_mps: float
    state: str
    outcome: str | None


def rest(
    episode: Episode, steering: SteeringParameters, speed: SpeedParameters
) -> Iterator[Progress]:
    """Drive on to the end under other fuzzy controllers.

    Args:
        episode: of `Snapshots.at`; is changed.
        steering: `steering.toml`.
        speed: `speed.toml`.
    """
    navigator = episode.navigator
    navigator.retune(replace(navigator.parameters, steering=steering, speed=speed))
    ticks = 0
    while episode.outcome is None:
        if ticks % REPORT_TICKS == 0:
            yield progress(episode)
        episode.tick()
        ticks += 1
    yield progress(episode)


def progress(episode: Episode) -> Progress:
    """How an episode stands."""
    x, y, z = episode.truth.position_m.tolist()
    speed_mps = episode.truth.speed_mps
    return Progress(episode.time_s, (x, y, z), speed_mps, episode.state, episode.outcome)
