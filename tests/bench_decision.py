"""What a decision costs: `python tests/bench_decision.py [seconds] [seed]` prints ms by state.

Drives the NQE; obstacles come from about 100 s on. Times are the process's own, so that a busy
machine changes them less, and caches are as the rest of the drive leaves them.
"""

import sys
import time
from collections import defaultdict
from collections.abc import Callable
from typing import Any

import numpy as np

from nav.control.low_level import LowLevelController
from nav.high_level import HighLevelController
from scenarios.episode import Episode
from scenarios.nqe import build

Spent = dict[str, list[float]]
"""Times in ms by what they were spent on."""


def metered(
    function: Callable[..., Any], spent_ms: Spent, name: Callable[[Any], str]
) -> Callable[..., Any]:
    """The same method; its times go to what `name` says of its object afterwards."""

    def spend(this: Any, *arguments: Any) -> Any:
        start_s = time.process_time()
        result = function(this, *arguments)
        spent_ms[name(this)].append((time.process_time() - start_s) * 1e3)
        return result

    return spend


def main() -> None:
    """Print the table."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 200.0
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    high: Spent = defaultdict(list)
    low: Spent = defaultdict(list)
    HighLevelController.decide = metered(HighLevelController.decide, high, _state)
    LowLevelController.step = metered(LowLevelController.step, low, lambda _: "low level")
    episode = Episode(build(seed), seed)
    while episode.outcome is None and episode.time_s < seconds:
        episode.tick()
    print(f"{'':20s}{'count':>8s}{'median':>10s}{'99 %':>10s}  [ms]")
    every = [spent for spents in high.values() for spent in spents]
    for name, spents in (*high.items(), ("all decisions", every), *low.items()):
        middle, most = np.quantile(spents, (0.5, 0.99))
        print(f"{name:20s}{len(spents):8d}{middle:10.3f}{most:10.3f}")


def _state(controller: HighLevelController) -> str:
    return controller.machine.state


if __name__ == "__main__":
    main()
