"""The full loop against bare physics, and our rays against Embree's: in turn, slice by slice.

What a busy machine takes, it takes from both; the median over the slices leaves out the rest.
"""

import time
from collections.abc import Iterator
from typing import NamedTuple

from ion.bench.bare import Bare
from ion.bench.beams import Cost, Duel
from scenarios.episode import Episode
from twin.simulator import TICK_STEPS, Simulator

SLICE_TICKS = 50
"""Of one slice, at most: a simulated second has everything in it that comes again and again."""


class Slice(NamedTuple):
    """Of the same stretch of a drive, wall time."""

    full_s: float
    """Of `Episode.tick`, the tape's digest included, [s]."""
    bare_s: float
    """Of MuJoCo's bare steps, [s]."""
    ray: Cost


def cut(ticks: int) -> list[int]:
    """So many ticks of 20 ms in slices that are about equal."""
    count = -(-ticks // SLICE_TICKS)
    return [ticks * (i + 1) // count - ticks * i // count for i in range(count)]


def race(
    episode: Episode, simulator: Simulator, slices: list[int], with_embree: bool
) -> Iterator[Slice]:
    """Drive on, slice by slice; a drive that ends leaves out the rest."""
    duel = Duel()
    for i, ticks in enumerate(slices):
        full_s, bare_s = _both_s(episode, simulator, ticks, full_first=i % 2 == 0)
        if episode.outcome is not None:
            return
        yield Slice(full_s, bare_s, duel.cost(simulator, with_embree))


def _both_s(
    episode: Episode, simulator: Simulator, ticks: int, full_first: bool
) -> tuple[float, float]:
    """Wall time of the full loop and of bare physics from the same state on, [s]."""
    bare, steps = Bare(simulator.plant), ticks * TICK_STEPS
    if full_first:
        return drive_s(episode, ticks), bare.wall_s(steps)
    bare_s = bare.wall_s(steps)
    return drive_s(episode, ticks), bare_s


def drive_s(episode: Episode, ticks: int) -> float:
    """Wall time of so many ticks, or of those that are left to the drive's end, [s]."""
    start_s = time.perf_counter()
    for _ in range(ticks):
        if episode.outcome is not None:
            break
        episode.tick()
    return time.perf_counter() - start_s
