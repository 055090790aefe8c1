"""What an episode costs: `python tests/bench_episode.py [seconds]` prints ms a simulated second.

An NQE drive with its full tape, part by part. The total is processor time, so that a busy machine
changes it less; the wall clock, which is quicker to read, only shares it out. The meter's own
share is about 3 ms.
"""

import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import mujoco

import scenarios.episode
from nav.navigator import IonNavigator
from scenarios.episode import Episode
from scenarios.nqe import build
from scenarios.verdicts import Judge
from tape.digest import Digest
from tape.view import View
from tape.writer import TapeWriter
from twin.plant import Plant
from twin.sensors.lidar import Lidar
from twin.sensors.suite import SensorSuite
from twin.terrain import TerrainWindow

SEED = 0
NQE_S = 860.0
"""About what a whole NQE takes, simulated."""
PARTS = {
    "physics": [(mujoco, "mj_step1"), (mujoco, "mj_step2")],
    "plant": [(Plant, "apply"), (Plant, "step"), (Plant, "truth")],
    "LIDAR": [(Lidar, "measure")],
    "other sensors": [(SensorSuite, "poll")],
    "terrain": [(TerrainWindow, "recenter"), (TerrainWindow, "write_hfield")],
    "navigator": [(IonNavigator, "step")],
    "judge": [(Judge, "observe")],
    "tape: encode, digest": [(scenarios.episode, "record"), (Digest, "update")],
    "tape: file": [(TapeWriter, "write"), (TapeWriter, "close")],
}
"""What belongs to each part; what it calls of another part is the other's."""


class Meter:
    """Charges time to one part at a time."""

    def __init__(self, parts: Iterable[str]) -> None:
        self.spent_s = dict.fromkeys((*parts, "rest"), 0.0)
        self._part, self._since_s = "rest", time.perf_counter()

    def switch(self, part: str) -> str:
        """From now on it is `part` that spends; returns which one did."""
        now_s, before = time.perf_counter(), self._part
        self.spent_s[before] += now_s - self._since_s
        self._part, self._since_s = part, now_s
        return before

    def metered(self, part: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The same function, at the expense of `part`."""

        def spend(*arguments: Any, **options: Any) -> Any:
            before = self.switch(part)
            try:
                return function(*arguments, **options)
            finally:
                self.switch(before)

        return spend


def drive(episode: Episode, seconds: float) -> float:
    """Drive on with a full tape; returns the simulated time, [s]."""
    start_s = episode.time_s
    view = View(episode.navigator.parameters.vehicle.lidar_mounts)
    with (
        tempfile.TemporaryDirectory() as folder,
        TapeWriter(Path(folder) / "tape.mcap", mode="full", view=view) as writer,
    ):
        while episode.outcome is None and episode.time_s - start_s < seconds:
            for record in episode.tick():
                writer.write(record)
    return episode.time_s - start_s


def main() -> None:
    """Print the table."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 40.0
    meter = Meter(PARTS)
    for part, owned in PARTS.items():
        for owner, name in owned:
            setattr(owner, name, meter.metered(part, getattr(owner, name)))
    episode = Episode(build(SEED), SEED)
    drive(episode, 2.0)  # what is compiled, is compiled now
    meter.switch("rest")
    meter.spent_s = dict.fromkeys(meter.spent_s, 0.0)
    start_s = time.process_time()
    driven_s = drive(episode, seconds)
    meter.switch("rest")
    total = (time.process_time() - start_s) / driven_s * 1e3
    wall_s = sum(meter.spent_s.values())
    ms = {part: spent_s / wall_s * total for part, spent_s in meter.spent_s.items()}
    for part, spent in (*ms.items(), ("total", total)):
        print(f"{part:22s}{spent:8.2f} ms")
    print(f"{1e3 / total:.1f} times real time: {NQE_S * total / 1e3:.0f} s for {NQE_S:.0f} s")


if __name__ == "__main__":
    main()
