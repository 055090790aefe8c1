"""`ion scenarios`: what can be driven by name, what one's own files say, and what can vary."""

import json
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from ion.courses import SUFFIX
from ion.errors import UsageError
from ion.scenarios.options import Options
from scenarios.bounds import Bound
from scenarios.scenario import load_scenario, scenario_names
from scenarios.scenario_file import (
    ARRIVED,
    ScenarioFile,
    ScenarioFileError,
    built_in,
    read_scenario,
)
from scenarios.settings import names


def scenarios(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: no such folder, or a file in it that is no scenario.
    """
    rows = _settings() if options.settings else [_row(s) for s in _all(options.folder)]
    if options.json:
        for row in rows:
            print(json.dumps(row))
    else:
        Console().print(_table(rows))
    return 0


def _settings() -> list[dict[str, Any]]:
    return [{"name": name, "value": value} for name, value in names().items()]


def _all(folder: Path | None) -> list[ScenarioFile]:
    found = [built_in(name) for name in scenario_names()]
    if folder is None:
        return found
    if not folder.is_dir():
        raise UsageError(f"{folder}: expected a folder with scenario files (*{SUFFIX})")
    try:
        return found + [read_scenario(path) for path in sorted(folder.glob(f"*{SUFFIX}"))]
    except ScenarioFileError as error:
        raise UsageError(str(error)) from error


def _row(scenario: ScenarioFile) -> dict[str, Any]:
    own = scenario.course == scenario.name
    options = {k: str(v) for k, v in load_scenario(scenario.name).options.items()} if own else {}
    return {
        "name": scenario.name,
        "title": scenario.title,
        "course": scenario.course or scenario.route,
        "options": options,
        "vary": list(scenario.vary),
        "verdicts": {k: _bound(v) for k, v in (scenario.verdicts or ARRIVED).items()},
    }


def _bound(bound: Any) -> Any:
    return str(bound) if isinstance(bound, Bound) else bound


def _table(rows: list[dict[str, Any]]) -> Table:
    table = Table(show_header=False)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for row in rows:
        first, second, *rest = row.items()
        more = [f"  {key}: {_listed(value)}" for key, value in rest if value]
        table.add_row(str(first[1]), "\n".join([str(second[1]), *more]))
    return table


def _listed(value: Any) -> str:
    if isinstance(value, dict):
        return "; ".join(f"{k}: {v}" for k, v in value.items())
    return ", ".join(value) if isinstance(value, list) else str(value)
