"""What the navigator costs: `python tests/bench_navigator.py [seconds] [seed]` prints ms a
simulated second.

The messages of an NQE drive are recorded once; then fresh navigators take them, pass after pass.
Of each call the least time counts: a busy machine adds time and never takes any. The messages are
made by the twin or the truck's drivers, and so are no part of the navigator: their making has a
line of its own.
"""

import sys
import time
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from ion.bench.meter import Meter, Parts, metering
from nav.admission import Admission
from nav.control.low_level import LowLevelController
from nav.fusion.ego_state import EgoState
from nav.fusion.obstacle_map import ObstacleMap
from nav.high_level import HighLevelController
from nav.messages import LidarScan, SensorMessage
from nav.navigator import IonNavigator
from nav.parameters import parameters_from
from nav.route import rddf
from scenarios.episode import Episode
from scenarios.nqe import build
from scenarios.parameter_files import parameter_texts

PASSES = 10
PARTS: Parts = {
    "admission": [(Admission, "admit")],
    "ego state": [(EgoState, "update"), (EgoState, "estimate"), (EgoState, "pose_at")],
    "map": [
        (ObstacleMap, "recenter"),
        (ObstacleMap, "integrate"),
        (ObstacleMap, "integrate_sonar"),
    ],
    "high level": [(HighLevelController, "decide")],
    "low level": [(LowLevelController, "step"), (LowLevelController, "command_is")],
}

Step = tuple[int, Sequence[SensorMessage]]
"""What the navigator is given in one call."""


def recorded(seconds: float, seed: int) -> list[Step]:
    """All that the navigator hears in the first `seconds` of a drive."""
    episode, steps = Episode(build(seed), seed), list[Step]()
    take = episode.navigator.step

    def listen(time_ns: int, messages: Sequence[SensorMessage]) -> Any:
        steps.append((time_ns, messages))
        return take(time_ns, messages)

    episode.navigator.step = listen
    while episode.outcome is None and episode.time_s < seconds:
        episode.tick()
    return steps


def navigated(seed: int, steps: list[Step], meter: Meter) -> list[list[float]]:
    """One pass of a fresh navigator: for each call the time of each part, [s]."""
    course = build(seed)
    route = rddf.parse(course.route_text, course.route_name)
    navigator = IonNavigator(parameters_from(parameter_texts()), route)
    spent: list[list[float]] = []
    for time_ns, messages in steps:
        meter.restart()
        navigator.step(time_ns, messages)
        meter.switch("rest")
        spent.append(list(meter.spent_s.values()))
    return spent


def made(steps: list[Step]) -> float:
    """Time to make all messages again, [s]."""
    told = [
        (type(message), [_as_sensed(message, f.name) for f in fields(message)])
        for _, messages in steps
        for message in messages
    ]
    start_s = time.perf_counter()
    for kind, values in told:
        kind(*values)
    return time.perf_counter() - start_s


def _as_sensed(message: SensorMessage, name: str) -> Any:
    """A field's value; ranges of a scan as a new array, as its decoder makes them."""
    value = getattr(message, name)
    return value.copy() if isinstance(message, LidarScan) and name == "range_m" else value


def main() -> None:
    """Print the table."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 30.0
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    steps = recorded(seconds, seed)
    with metering(PARTS) as meter:
        passes = [navigated(seed, steps, meter) for _ in range(PASSES)]
    driven_s = steps[-1][0] * 1e-9
    least_s = np.array(passes).min(axis=0).sum(axis=0).tolist()
    least = dict(zip(meter.spent_s, least_s, strict=True))
    making = min(made(steps) for _ in range(PASSES))
    for part, spent_s in (*least.items(), ("total", sum(least.values())), ("messages", making)):
        print(f"{part:12s}{spent_s / driven_s * 1e3:8.2f} ms")


if __name__ == "__main__":
    main()
