"""Localization: how far from the truth the navigator believes itself to be."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import dist, sqrt
from typing import Any

from nav.angles import wrapped
from nav.messages import EgoEstimate
from scenarios.behaviour.motion import newest
from scenarios.episode import Episode
from tape.record import Record
from twin.truth import Truth


@dataclass
class Localization:
    """Watches a run. The navigator's estimates (10 Hz), each against the truth of its tick."""

    position_m: float = 0.0
    """Greatest distance ..."""
    heading_rad: float = 0.0
    """... and greatest angle, to either side."""
    _sum2_m2: float = 0.0
    _count: int = 0

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the truth, and the estimate if this tick has one."""
        estimate = newest(records, EgoEstimate)
        if estimate is not None:
            self._compare(estimate, episode.truth)

    def _compare(self, estimate: EgoEstimate, truth: Truth) -> None:
        away_m = dist(estimate.position_m, truth.position_m[:2])
        turned_rad = abs(wrapped(estimate.heading_rad - truth.heading_rad))
        self.position_m = max(self.position_m, away_m)
        self.heading_rad = max(self.heading_rad, turned_rad)
        self._sum2_m2 += away_m * away_m
        self._count += 1

    def figures(self) -> dict[str, Any]:
        """What was measured; None without an estimate."""
        told = self._count > 0
        return {
            "position_error_rms_m": sqrt(self._sum2_m2 / self._count) if told else None,
            "position_error_max_m": self.position_m if told else None,
            "heading_error_max_rad": self.heading_rad if told else None,
        }
