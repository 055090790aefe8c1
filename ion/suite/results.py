"""What a suite has found so far: a line of JSON a drive, written as it ends."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ion.suite.cases import Case
from ion.telling import Result, as_json, verdict

FILE = "results.jsonl"


class Results:
    """By the number of the case."""

    def __init__(self, folder: Path, cases: Sequence[Case], code: str) -> None:
        """Take over what stands there and still holds; the rest is driven again."""
        self.path = folder / FILE
        self._cases, self._holds = cases, [case.holds_for(code) for case in cases]
        self.found: dict[int, Result] = self._read()
        lines = "".join(as_json(self.found[k]) + "\n" for k in sorted(self.found))
        self.path.write_text(lines, encoding="utf-8")

    @property
    def missing(self) -> list[int]:
        """Numbers of the cases without a result."""
        return [k for k in range(len(self._cases)) if k not in self.found]

    @property
    def failures(self) -> list[Result]:
        """Of those that have one, in the order of the cases."""
        return [result for _, result in sorted(self.found.items()) if result["failed"]]

    def add(self, number: int, driven: Mapping[str, Any]) -> Result:
        """Keep what a drive gave; an interrupted one is none."""
        case = self._cases[number]
        result = {"case": case.name, "holds": self._holds[number], "seed": case.seed}
        result |= {"failed": failed(driven)} | dict(driven)
        if driven["outcome"] != "interrupted":
            self.found[number] = result
            with self.path.open("a", encoding="utf-8") as file:
                file.write(as_json(result) + "\n")
        return result

    def _read(self) -> dict[int, Result]:
        number = {holds: k for k, holds in enumerate(self._holds)}
        read = [result for result in rows_of(self.path) if result.get("holds") in number]
        return {number[result["holds"]]: result for result in read if _kept(result)}


def rows_of(path: Path) -> list[Result]:
    """The lines of a file that is written as drives end; the last may be cut, and is then empty."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return [_parsed(line) for line in lines]


def run_of(result: Result) -> str:
    """The name of its run."""
    return result["case"].rsplit(" ", 1)[0]


def reasons(result: Result) -> list[str]:
    """Why a drive failed: its failed verdicts, or what broke it."""
    broken = [v for v in result.get("verdicts", ()) if not v["passed"]]
    told = [f"{v['figure']}: {verdict(v)}" for v in broken]
    return told or [result.get("message", result["outcome"])]


def failed(driven: Mapping[str, Any]) -> list[str]:
    """The figures whose verdicts failed; of a drive that broke, its error."""
    if "verdicts" not in driven:
        return [driven["outcome"]]
    return [verdict["figure"] for verdict in driven["verdicts"] if not verdict["passed"]]


def _parsed(line: str) -> Result:
    try:
        return json.loads(line)
    except json.JSONDecodeError:
        return {}


def _kept(result: Result) -> bool:
    """An error may have been the machine's, and a tape that is gone is worth another drive."""
    log = result.get("log")
    return result["outcome"] != "error" and (not log or Path(log).exists())
