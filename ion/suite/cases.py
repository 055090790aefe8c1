"""The drives of a suite, each of which any process can do by its number."""

from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, NamedTuple

from ion.courses import Source
from ion.job import Job
from scenarios.processor import fingerprint
from scenarios.scenario_file import ScenarioFile
from scenarios.suites import Suite

PACKAGES = ("nav", "twin", "scenarios", "models")
"""What a result depends on."""


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


def code() -> str:
    """What is the same as long as the code and the processor are."""
    found = sha256(repr(sorted(fingerprint().items())).encode())
    for package in PACKAGES:
        _add(found, files(package))
    return found.hexdigest()


def _add(found: Any, folder: Traversable) -> None:
    for item in sorted(folder.iterdir(), key=lambda item: item.name):
        if item.is_dir() and item.name != "__pycache__":
            _add(found, item)
        elif item.name.endswith((".py", ".toml", ".xml")):
            found.update(item.name.encode() + item.read_bytes())
