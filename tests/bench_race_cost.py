"""Does a mile cost more with the way behind it?
`python tests/bench_race_cost.py FOLDER [--seconds N]`.

FOLDER is what a whole race left, or leaves while it runs. Its last checkpoint drives on, and so
does a fresh drive of the same seed that begins at the same waypoint: the same ground and the same
things, without the miles before. In turn, second by second, with all that watches a drive;
processor time, so that a busy machine changes it less. Prints milliseconds for each simulated
second, and the ratio.
"""

import time
from argparse import ArgumentParser
from pathlib import Path
from statistics import fmean, median

from scenarios.processor import fix_processor

fix_processor()  # before numpy loads

from ion.courses import scenario_source  # noqa: E402
from ion.segments import Checkpoint, last_checkpoint  # noqa: E402
from ion.trace import Trace  # noqa: E402
from scenarios.behaviour import Behaviour  # noqa: E402
from scenarios.events import Events  # noqa: E402

SECOND = 50
"""Ticks."""
SETTLED_S = 20
"""The fresh drive must have come to speed."""
WAYPOINTS = 60


def fresh(late: Checkpoint) -> Checkpoint:
    """A drive that begins where `late` is."""
    assert late.episode.decision
    first = late.episode.decision.waypoint
    last = min(first + WAYPOINTS, len(late.episode.course.waypoint_m))
    source = scenario_source("gc05_route", {"first": first, "last": last})
    episode = source.episode(late.seed, ())
    return late._replace(episode=episode, trace=Trace(), events=Events(), behaviour=Behaviour())


def second_ms(drive: Checkpoint) -> float:
    """What the next simulated second costs."""
    watches = (drive.trace, drive.events, drive.behaviour)
    start = time.process_time()
    for _ in range(SECOND):
        records = drive.episode.tick()
        for watch in watches:
            watch(drive.episode, records)
    return (time.process_time() - start) * 1e3


def main() -> None:
    """Drive both, and compare."""
    ask = ArgumentParser(description=__doc__)
    ask.add_argument("folder", type=Path)
    ask.add_argument("--seconds", type=int, default=200)
    asked = ask.parse_args()
    late = last_checkpoint(asked.folder)
    print(f"after {late.episode.judge.movement.distance_m / 1e3:.0f} km")
    drives, cost = (fresh(late), late), list[list[float]]()
    for _ in range(asked.seconds):
        if any(drive.episode.outcome for drive in drives):
            break
        cost.append([second_ms(drive) for drive in drives])
    for name, of in (("median", median), ("mean", fmean)):
        without, whole = (of(each) for each in zip(*cost[SETTLED_S:], strict=True))
        print(f"{name} {whole:.1f} ms, without them {without:.1f} ms: {whole / without:.3f}")


if __name__ == "__main__":
    main()
