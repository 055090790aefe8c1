"""`ion compare`: drive every variant, tell, draw."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import mean
from typing import Any

from rich.console import Console
from rich.progress import track
from rich.table import Table

from ion.compare.options import Options, comparison_of
from ion.compare.picture import draw
from ion.compare.variants import Comparison, Drive, parted_s, probability
from ion.errors import UsageError
from scenarios.batch import many


@dataclass(frozen=True)
class Work:
    """One drive by its number, for `scenarios.batch`."""

    comparison: Comparison
    seeds: Sequence[int]

    def __len__(self) -> int:
        return len(self.comparison.variants) * len(self.seeds)

    def __call__(self, number: int) -> dict[str, Any]:
        variant, seed = divmod(number, len(self.seeds))
        return {"drive": self.comparison.drive(variant, self.seeds[seed])}


def compare(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option is wrong, or a drive broke.
        NavError: a stretch that the route does not have.
    """
    comparison, seeds = comparison_of(options)
    work = Work(comparison, seeds)
    drives = _driven(work, options.jobs)
    told = [_told(k, variant, drives) for k, variant in enumerate(comparison.variants)]
    if options.json:
        for row in told:
            print(json.dumps(row))
    else:
        Console().print(_table(told))
    draw([d for d in drives if d.seed == seeds[0]], comparison, options.out)
    if not options.json:
        print(f"picture: {options.out}")
    return 0


def _driven(work: Work, jobs: int) -> list[Drive]:
    """All drives, by variant and seed."""
    results = many(work, range(len(work)), jobs)
    bar = track(results, "driving", total=len(work), console=Console(stderr=True))
    found: list[Drive] = []
    for result in bar:
        if result.get("outcome") == "interrupted":
            raise KeyboardInterrupt
        if "drive" not in result:
            raise UsageError(f"a drive broke: {result.get('message')}")
        found.append(result["drive"])
    return sorted(found, key=lambda d: (d.variant, d.seed))


def _told(k: int, variant: dict[str, Any], drives: Sequence[Drive]) -> dict[str, Any]:
    """One variant, beside the first."""
    mine = [d for d in drives if d.variant == k]
    first = {d.seed: d for d in drives if d.variant == 0}
    finished = [d for d in mine if d.outcome == "finished"]
    share, low, high = probability(len(finished), len(mine))
    parted = [s for d in mine if (s := parted_s(first[d.seed], d)) is not None]
    outcomes = [d.outcome for d in mine]
    return {
        "variant": variant,
        "drives": len(mine),
        "outcomes": {word: outcomes.count(word) for word in sorted(set(outcomes))},
        "finished": share,
        "finished_95": [low, high],
        "time_s": mean(d.time_s for d in mine),
        "waypoints": mean(d.waypoints for d in mine),
        "robotic_operations_s": mean(d.operations_s for d in mine),
        "parted_s": min(parted, default=None),
    }


def _table(rows: Sequence[dict[str, Any]]) -> Table:
    table = Table(
        *rows[0]["variant"], "outcome", "finished", "95 %", "time s", "waypoints",
        "robotic s", "parts at s",
    )  # fmt: skip
    for row in rows:
        low, high = row["finished_95"]
        outcomes = ", ".join(f"{n} {word}" for word, n in row["outcomes"].items())
        parted = "" if row["parted_s"] is None else f"{row['parted_s']:.0f}"
        table.add_row(
            *(f"{value}" for value in row["variant"].values()), outcomes,
            f"{row['finished']:.0%}", f"{low:.0%} to {high:.0%}", f"{row['time_s']:.0f}",
            f"{row['waypoints']:.0f}", f"{row['robotic_operations_s']:.0f}", parted,
        )  # fmt: skip
    return table
