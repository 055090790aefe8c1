"""Mutation testing of a suite: which of its verdicts catches each broken navigator.

A verdict that also fails the healthy navigator, with any seed, catches nobody.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import track

from ion.job import stop_when_asked
from ion.suite.cases import Case
from ion.suite.options import Options
from ion.suite.results import Results, failed, rows_of
from ion.telling import as_json
from scenarios.batch import many, stop_asked
from scenarios.behaviour import Behaviour
from scenarios.mutants import MUTANTS, mutated
from scenarios.run import run

FILE = "mutants.jsonl"
Catch = dict[str, Any]


@dataclass(frozen=True)
class Drives:
    """Lets one mutant after the other drive all cases until a verdict catches it."""

    cases: Sequence[Case]
    unfit: frozenset[str]
    """Verdicts that the healthy navigator fails, as run and figure."""

    def __call__(self, number: int) -> Catch:
        name = list(MUTANTS)[number]
        for case in self.cases:
            driven = self._driven(name, case)
            if driven["outcome"] == "interrupted" or stop_asked():
                return {"seed": number, "outcome": "interrupted"}
            for figure in failed(driven):
                if verdict_of(case, figure) not in self.unfit:
                    by = {"case": case.name, "figure": figure, "value": _value(driven, figure)}
                    return {"seed": number, "outcome": "caught", "mutant": name, "by": by}
        return {"seed": number, "outcome": "escaped", "mutant": name, "by": None}

    def _driven(self, name: str, case: Case) -> dict[str, Any]:
        """A mutant that breaks down has been caught by that."""
        try:
            episode, behaviour = mutated(case.scenario.episode(case.seed), name), Behaviour()
            figures = run(episode, None, [behaviour, stop_when_asked]) | behaviour.figures()
        except Exception as error:
            return {"outcome": f"{type(error).__name__}: {error}"}
        return figures | {"verdicts": [v._asdict() for v in case.scenario.judged(figures)]}


class Hunt:
    """All mutants, and what is known of them so far."""

    def __init__(self, cases: Sequence[Case], folder: Path, healthy: Results, code: str) -> None:
        self.path = folder / FILE
        unfit = {verdict_of(cases[k], f) for k, r in healthy.found.items() for f in r["failed"]}
        self.drives = Drives(cases, frozenset(unfit))
        said = "".join(case.holds_for(code) for case in cases)
        self.holds = sha256(said.encode()).hexdigest()[:16]

    @cached_property
    def known(self) -> dict[str, Any]:
        """By mutant: what caught it, or None."""
        rows = rows_of(self.path)
        return {row["mutant"]: row["by"] for row in rows if row.get("holds") == self.holds}

    def add(self, catch: Catch) -> None:
        """Keep what a hunt gave."""
        if catch["outcome"] not in ("caught", "escaped"):
            return
        self.known[catch["mutant"]] = catch["by"]
        with self.path.open("a", encoding="utf-8") as file:
            file.write(as_json({**catch, "holds": self.holds}) + "\n")


def caught_by(hunt: Hunt, options: Options) -> Catch:
    """Let those drive of whom nothing is known; who was caught by what."""
    due = [k for k, name in enumerate(MUTANTS) if name not in hunt.known]
    if due:
        drives = many(hunt.drives, due, options.jobs)
        for catch in track(drives, "mutants", total=len(due), console=Console(stderr=True)):
            hunt.add(catch)
    known = {name: hunt.known.get(name) for name in MUTANTS}
    caught = len([by for by in known.values() if by])
    return {"mutants": len(MUTANTS), "caught": caught, "caught_by": known}


def verdict_of(case: Case, figure: str) -> str:
    """A verdict is a run's and a figure's, with any seed."""
    return f"{case.scenario.name} {figure}"


def _value(driven: dict[str, Any], figure: str) -> Any:
    values = {v["figure"]: v["value"] for v in driven.get("verdicts", ())}
    return values.get(figure, driven["outcome"])
