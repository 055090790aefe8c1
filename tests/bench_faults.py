"""Every fault kind on every sensor, one at a time, over a course: `python tests/bench_faults.py
[--jobs N] [--scenario nqe] [--seed N] [LINE ...]`, a line as `--fault` takes it.

A line of a table for each: how it ended, contacts, departures, clearance, and when it stood
at last, after the fault had begun. An hour on two cores for the whole NQE.
"""

import sys
from argparse import ArgumentParser
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from typing import Any

from ion.courses import scenario_source
from scenarios.episode import Episode
from scenarios.processor import fix_processor
from scenarios.run import run
from scenarios.vehicles import VEHICLES
from twin.faults import ACTUATORS, KINDS, parse

FROM = "120s"
STANDS_MPS = 0.1
UNFITTED = ("road_camera",)
"""Sees no road on most courses; see tests/bench_faults.py --scenario road."""


def lines() -> list[str]:
    """All kinds of all sensors of ION."""
    known = [d for d in VEHICLES["ion"].devices if d not in (*ACTUATORS, *UNFITTED)]
    return [f"{device} {kind} {FROM}" for device in known for kind in KINDS]


def drive(scenario: str, seed: int, line: str) -> dict[str, Any]:
    """One drive with one fault: its figures, and since when it stood at the end, [s]."""
    course = replace(scenario_source(scenario), faults=(line,)).course(seed)
    stood_s: list[float] = []

    def stands(episode: Episode, records: object) -> None:
        del records  # Unused.
        if abs(episode.truth.speed_mps) > STANDS_MPS:
            stood_s.clear()
        elif not stood_s:
            stood_s.append(episode.time_s)

    figures = run(Episode(course, seed), None, [stands])
    fault = parse(line, VEHICLES[course.vehicle].devices)
    after_s = stood_s[0] - fault.begins if stood_s and fault.unit == "s" else None
    return figures | {"line": line, "stood_after_s": after_s}


def row(f: dict[str, Any]) -> str:
    """Of a table in Markdown."""
    stood = f["stood_after_s"] if f["outcome"] != "finished" else None
    cells = (
        f["line"], f["outcome"], f"{f['gates_passed']} of {f['gates_total']}", f["contacts"],
        f["departures"], f"{f['min_clearance_m'] or 0.0:.2f}", f"{f['sim_time_s']:.0f}",
        "" if stood is None else f"{stood:.1f}",
    )  # fmt: skip
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def main() -> None:
    """Drive all of them; what is done is printed at once."""
    ask = ArgumentParser(description=__doc__)
    ask.add_argument("lines", nargs="*")
    ask.add_argument("--jobs", type=int, default=1)
    ask.add_argument("--scenario", default="nqe")
    ask.add_argument("--seed", type=int, default=0)
    asked = ask.parse_args()
    print("| fault | outcome | gates | contacts | departures | clearance m | s | stood after s |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    fix_processor()
    with ProcessPoolExecutor(asked.jobs, get_context("spawn")) as pool:
        due = [
            pool.submit(drive, asked.scenario, asked.seed, line) for line in asked.lines or lines()
        ]
        for k, done in enumerate(due, 1):
            print(row(done.result()), flush=True)
            print(f"{k} of {len(due)}", file=sys.stderr)


if __name__ == "__main__":
    main()
