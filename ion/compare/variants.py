"""The drives of a comparison, and what they come to."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any, NamedTuple

from ion.courses import Source
from scenarios.variation import Vary, apply, variants

EVERY_TICKS = 50
"""From one look at a drive to the next: 1 s."""
Z = 1.96
"""Of a 95 % interval."""


class Look(NamedTuple):
    """A drive at one of its seconds."""

    time_s: float
    way_m: float
    bits: str
    """The first of the digest so far."""


class Drive(NamedTuple):
    """How one variant went for one seed."""

    variant: int
    seed: int
    outcome: str
    time_s: float
    waypoints: int
    operations_s: float
    """In Robotic Operations."""
    looks: list[Look]


@dataclass(frozen=True)
class Comparison:
    """What is compared. Small, so that it travels to other processes."""

    source: Source
    varies: Sequence[Vary]
    at_s: float

    @property
    def variants(self) -> list[dict[str, Any]]:
        """What each sets."""
        return variants(self.varies)

    def drive(self, variant: int, seed: int) -> Drive:
        """From the start to the end, other from `at_s` on."""
        from scenarios.episode import Episode

        episode, looks, ticks, varied = Episode(self.source.course(seed), seed), [], 0, False
        while episode.outcome is None:
            if not varied and episode.time_s >= self.at_s - 1e-9:
                apply(episode, self.variants[variant])
                varied = True
            episode.tick()
            ticks += 1
            if ticks % EVERY_TICKS == 0 or episode.outcome:
                looks.append(_look(episode))
        figures = episode.judge.figures()
        operations_s = figures["states"].get("robotic_operations", 0.0)
        passed = figures["waypoints_passed"]
        return Drive(variant, seed, episode.outcome, episode.time_s, passed, operations_s, looks)


def _look(episode: Any) -> Look:
    way_m = episode.judge.movement.distance_m
    return Look(episode.time_s, way_m, episode.digest.hex()[:16])


def parted_s(one: Drive, other: Drive) -> float | None:
    """The first second in which two drives differ; None where they never do."""
    for a, b in zip(one.looks, other.looks, strict=False):
        if a.bits != b.bits:
            return b.time_s
    ends = min(one.looks[-1].time_s, other.looks[-1].time_s)
    return None if len(one.looks) == len(other.looks) else ends


def probability(finished: int, drives: int) -> tuple[float, float, float]:
    """Share of drives that finished, and its 95 % interval (Wilson 1927)."""
    share, z2 = finished / drives, Z * Z / drives
    middle = (share + z2 / 2.0) / (1.0 + z2)
    half = Z * sqrt(share * (1.0 - share) / drives + z2 / (4.0 * drives)) / (1.0 + z2)
    return share, max(middle - half, 0.0), min(middle + half, 1.0)
