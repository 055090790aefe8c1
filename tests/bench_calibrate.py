"""How true `ion calibrate` is: `python tests/bench_calibrate.py [seeds] [jobs]`.

Makes so many tapes (5 by default) of the manoeuvre with the model's own values, then with two other
sets, each with a seed of its own from 0 on. Fits each, and prints every error, the largest of each
parameter, and how often the 95 % interval held the truth. About 20 s a tape. Exit code 1: an error
of 2 % or more.
"""

import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from scenarios.calibration.evidence import evidence
from scenarios.calibration.fit import fit
from scenarios.calibration.quantities import FITTED, QUANTITIES
from scenarios.calibration.recording import record_manoeuvre
from tape.writer import TapeWriter

TRUTHS = (
    {},
    {"mass": 1250.0, "friction": 0.55, "steering": 0.9, "cg_height": 0.72},
    {"mass": 900.0, "friction": 0.85, "steering": 1.12, "cg_height": 0.52},
)
ALLOWED = 0.02


def found(truth: dict[str, float], seed: int) -> dict[str, tuple[float, float]]:
    """The relative error of each parameter, and half the width of its interval."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tape.mcap"
        with TapeWriter(path, mode="inputs") as tape:
            record_manoeuvre(tape, seed, truth)
        result = fit(evidence(path), FITTED)
    made = {name: truth.get(name, QUANTITIES[name].model) for name in FITTED}
    return {
        f.name: (f.value / made[f.name] - 1.0, f.half_width / made[f.name])
        for f in result.found
        if f.name in made
    }


def main(seeds: int, jobs: int) -> int:
    cases = [(TRUTHS[n // seeds], n) for n in range(len(TRUTHS) * seeds)]
    every: dict[str, list[tuple[float, float]]] = {name: [] for name in FITTED}
    with ProcessPoolExecutor(jobs) as pool:
        results = pool.map(found, *zip(*cases, strict=True))
        for (truth, seed), errors in zip(cases, results, strict=True):
            told = [f"{n} {100 * e:+.2f} ± {100 * w:.2f} %" for n, (e, w) in errors.items()]
            print(f"truth {TRUTHS.index(truth)}, seed {seed}: {', '.join(told)}", flush=True)
            for name, pair in errors.items():
                every[name].append(pair)
    return _summary(every)


def _summary(every: dict[str, list[tuple[float, float]]]) -> int:
    worst = {name: max(abs(e) for e, _ in pairs) for name, pairs in every.items()}
    for name, pairs in every.items():
        held = sum(abs(e) <= w for e, w in pairs)
        print(
            f"{name}: at most {100 * worst[name]:.2f} % off; {held} of {len(pairs)} intervals hold"
        )
    return int(max(worst.values()) >= ALLOWED)


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    sys.exit(main(*(given + [5, 1][len(given) :])))
