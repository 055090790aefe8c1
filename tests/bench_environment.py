"""What the environment costs beside the twin and the judge, interleaved in one run."""

import time

import numpy as np

from nav.messages import ActuatorTargets, Gear
from scenarios.environment import load

STEPS, ROUNDS = 250, 8
ACTION = np.array([0.0, 0.1, 0.0, 3.0])


def bare(environment) -> float:
    """Seconds for STEPS steps of twin and judge alone."""
    started = time.perf_counter()
    for _ in range(STEPS):
        now_ns = environment.simulator.time_ns
        environment.simulator.advance(ActuatorTargets(now_ns, 0.0, 0.1, 0.0, Gear.HIGH))
        environment.judge.observe(environment.simulator.truth(), None, None)
    return time.perf_counter() - started


def whole(environment) -> float:
    """Seconds for STEPS steps of the environment."""
    started = time.perf_counter()
    for _ in range(STEPS):
        environment.step(ACTION)
    return time.perf_counter() - started


def main() -> None:
    """Print both and their ratio."""
    one, other = load("nqe"), load("nqe")
    for environment in (one, other):
        environment.reset()
    bare(one), whole(other)
    pairs = [(bare(one), whole(other)) for _ in range(ROUNDS)]
    alone, all_of_it = (1e3 * float(np.median(side)) / STEPS for side in zip(*pairs, strict=True))
    print(f"twin and judge {alone:.3f} ms a step, environment {all_of_it:.3f} ms: "
          f"{all_of_it / alone:.3f} times")  # fmt: skip


if __name__ == "__main__":
    main()
