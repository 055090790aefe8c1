"""One episode from where it is to its end."""

import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

from scenarios.interrupts import interrupts

if TYPE_CHECKING:
    from scenarios.episode import Episode
    from tape.record import Record


class Tape(Protocol):
    """What takes records: `tape.writer.TapeWriter`, `tape.held_back.HeldBack`."""

    def write(self, record: "Record") -> None:
        """Take the next record."""
        ...


Watch = Callable[["Episode", Sequence["Record"]], None]
"""Is shown the episode and what it recorded after every tick; returns nothing, may raise
`KeyboardInterrupt` to end the drive."""


def run(
    episode: "Episode", writer: Tape | None = None, watches: Sequence[Watch] = ()
) -> dict[str, Any]:
    """Drive to the end; Ctrl-C ends the drive between two ticks with the outcome `interrupted`.

    Args:
        episode: is changed.
        writer: takes every record; whoever opened it closes it.
        watches: progress bars, traces.

    Returns:
        The episode's figures, with `wall_time_s` and `real_time_factor`.
    """
    wall_s, sim_s = time.perf_counter(), episode.time_s
    with interrupts() as caught:
        while episode.outcome is None:
            _tick(episode, writer, watches)
            if caught:
                episode.judge.stop("interrupted")
    wall_s = time.perf_counter() - wall_s
    factor = (episode.time_s - sim_s) / wall_s
    return episode.figures() | {"wall_time_s": wall_s, "real_time_factor": factor}


def _tick(episode: "Episode", writer: Tape | None, watches: Sequence[Watch]) -> None:
    records = episode.tick()
    if writer:
        for item in records:
            writer.write(item)
    try:
        for watch in watches:
            watch(episode, records)
    except KeyboardInterrupt:
        episode.judge.stop("interrupted")
