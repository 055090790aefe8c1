"""Speed: above the corridor's limit, on average, and backwards."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from scenarios.behaviour.motion import MOVES_MPS
from scenarios.course import Course
from scenarios.episode import Episode
from scenarios.verdicts.judge import TICK_S
from tape.record import Record

GRACE_M = 15.0
"""A lower limit holds from this far behind its waypoint: from 25 to 10 mph at 3 m/s^2 take 18 m,
of which some may lie before it."""


def _limits() -> list[tuple[float, float]]:
    return []


@dataclass
class Speed:
    """Watches a run. From the true speed, and the course's limit on the present segment."""

    over_mps: float | None = None
    """Largest excess over the limit, 0 if there was none."""
    reversed_m: float = 0.0
    _way_m: float = 0.0
    _moving_m: float = 0.0
    _moving_s: float = 0.0
    _segment: int = -1
    _limit_mps: float = 0.0
    _left: list[tuple[float, float]] = field(default_factory=_limits)
    """Limits [m/s] of the last segments, and the way [m] at which each was left."""

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the truth of this tick."""
        del records  # Unused.
        speed = episode.truth.speed_mps
        step_m = abs(speed) * TICK_S
        self._way_m += step_m
        if abs(speed) > MOVES_MPS:
            self._moving_m += step_m
            self._moving_s += TICK_S
            self.reversed_m += step_m if speed < 0.0 else 0.0
        limit = self._limit(episode.course, episode.judge.progress.segment)
        self.over_mps = max(self.over_mps or 0.0, abs(speed) - limit)

    def _limit(self, course: Course, segment: int) -> float:
        """The highest that is in force here, or was within `GRACE_M`."""
        segment = min(segment, len(course.speed_mps) - 2)  # behind the last waypoint nothing is
        if segment != self._segment:
            if self._segment >= 0:
                self._left.append((self._limit_mps, self._way_m))
            self._segment, self._limit_mps = segment, float(course.speed_mps[segment])
        while self._left and self._way_m - self._left[0][1] > GRACE_M:
            self._left.pop(0)
        return max(self._limit_mps, *(limit for limit, _ in self._left), 0.0)

    def figures(self) -> dict[str, Any]:
        """What was measured; None where it did not move."""
        moved = self._moving_s > 0.0
        return {
            "over_limit_mps": self.over_mps,
            "mean_moving_mps": self._moving_m / self._moving_s if moved else None,
            "reversed_m": self.reversed_m,
        }
