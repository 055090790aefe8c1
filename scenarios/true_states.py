"""Lets the tape tell what really happened, ten times a second: for viewers and reports."""

from collections.abc import Sequence

from scenarios.episode import Episode
from scenarios.run import Tape
from tape.record import Record, record_of_truth
from tape.truth import TrueState

EVERY = 5
"""Ticks from one true state to the next: 10 Hz."""


class TrueStates:
    """Watches a run, and writes to its tape."""

    def __init__(self, tape: Tape) -> None:
        self._tape, self._tick = tape, 0

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take the truth of this tick."""
        del records  # Unused.
        if self._tick % EVERY == 0 or episode.outcome:
            self._tape.write(record_of_truth(_state(episode)))
        self._tick += 1


def _state(episode: Episode) -> TrueState:
    t = episode.truth
    return TrueState(
        t.time_ns, t.position_m, t.heading_rad, t.roll_rad, t.pitch_rad, t.speed_mps,
        t.tire_center_m,
    )  # fmt: skip
