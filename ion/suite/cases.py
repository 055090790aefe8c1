"""The drives of a suite, each of which any process can do by its number."""

from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

from ion.courses import Source
from ion.job import Job
from scenarios.scenario_file import ScenarioFile
from scenarios.suites import Suite


class Case(NamedTuple):
    """One drive."""

    scenario: ScenarioFile
    seed: int

    @property
    def name(self) -> str:
        """As results and people call it."""
        return f"{self.scenario.name} {self.seed}"

    def holds_for(self, code: str) -> str:
        """What must be the same for its result to be the same."""
        said = f"{code} {self.seed} {self.scenario.as_json()}"
        return sha256(said.encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Work:
    """Drives a case by its number, for `scenarios.batch`."""

    cases: Sequence[Case]
    out: Path
    log: str

    def __call__(self, number: int) -> dict[str, Any]:
        case = self.cases[number]
        source = Source("", file=case.scenario)
        job = Job(source, self.out, self.log, failures_only=True)
        return {"number": number} | job.drive_in_worker(case.seed)


def cases_of(suite: Suite) -> list[Case]:
    """All drives: every run's first seed, then every run's second, so that what is stopped early
    has seen a bit of all."""
    most = max(len(run.seeds) for run in suite.runs)
    return [
        Case(run.scenario, run.seeds[k])
        for k in range(most)
        for run in suite.runs
        if k < len(run.seeds)
    ]
