"""`ion truth`: run the checks, tell how they came out, and put them on one page."""

import json
from typing import Any

from rich.console import Console
from rich.progress import track
from rich.table import Table

from ion.out_file import write_whole
from ion.truth.options import Options, checked
from ion.truth.page import page
from ion.truth.words import row
from scenarios.truth import CHECKS, Check

HOLDS, DOES_NOT = 0, 1


def truth(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an unknown check, or a page that cannot be written.
    """
    names = checked(options)
    console = Console(stderr=True)
    found = {name: CHECKS[name]() for name in track(names, "checking", console=console)}
    write_whole(options.out, page(found))
    if options.json:
        for name, check in found.items():
            print(json.dumps(said(name, check)))
    else:
        Console().print(_table(found))
        print(f"page: {options.out}")
    return HOLDS if all(check.holds for check in found.values()) else DOES_NOT


def said(name: str, check: Check) -> dict[str, Any]:
    """A check for JSON."""
    low, high, reference = check.allowed
    return {
        "check": name, "title": check.title, "unit": check.unit, "twin": check.twin,
        "reference": reference, "low": low, "high": high, "off": check.off,
        "grade": check.grade, "source": check.source, "holds": check.holds,
    }  # fmt: skip


def _table(found: dict[str, Check]) -> Table:
    table = Table("check", "twin", "allowed", "grade", "")
    for name, check in found.items():
        _, _, twin, allowed, *_ = row(name, check)
        holds = "[green]holds[/]" if check.holds else "[red]does not hold[/]"
        table.add_row(name, twin, allowed, check.grade, holds)
    return table
