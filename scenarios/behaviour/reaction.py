"""Reaction: how little time there ever was before something could be touched."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from scenarios.episode import Episode
from tape.record import Record

FAST_MPS = 0.5
"""Slower than this nothing is pressing."""
SURE_M = 15.0
"""The judge's clearance is right up to here (`scenarios.verdicts.clearance`)."""


@dataclass
class Reaction:
    """Watches a run. From the judge's clearance to obstacles, gates and walls, and the speed."""

    margin_s: float | None = None
    """Least clearance over speed, in whatever direction the obstacle lies."""

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the truth of this tick."""
        del records  # Unused.
        clearance_m, speed = episode.judge.clearance.now_m, abs(episode.truth.speed_mps)
        if speed > FAST_MPS and clearance_m <= SURE_M:
            margin_s = clearance_m / speed
            self.margin_s = margin_s if self.margin_s is None else min(self.margin_s, margin_s)

    def figures(self) -> dict[str, Any]:
        """What was measured; None where nothing was near."""
        return {"approach_margin_s": self.margin_s}
