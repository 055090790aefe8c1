"""`ion calibrate`: make a tape of the manoeuvre, or find the vehicle's parameters on one."""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from ion.calibrate.numbers import numbers
from ion.calibrate.options import Options, check_record, names_of, page_path, truth_of
from ion.calibrate.page import page
from ion.calibrate.table import table
from ion.errors import UsageError
from ion.out_file import check_file, write_whole
from scenarios.calibration.evidence import MADE, evidence
from scenarios.calibration.fit import expected_drives, fit
from scenarios.calibration.manoeuvre import manoeuvre
from scenarios.calibration.quantities import QUANTITIES, VEHICLE
from scenarios.calibration.recording import record_manoeuvre
from scenarios.processor import fingerprint
from tape.writer import TapeWriter

NEEDED = ("scipy", "absl", "colorama", "imageio", "jinja2", "plotly", "yaml", "tabulate")
"""What `mujoco.sysid` imports beyond what the base install brings."""
MISSING = (
    "calibrate needs mujoco.sysid, which is not installed;"
    " expected the extra: pip install 'ion-twin[calibrate]'"
)


def calibrate(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option is wrong, or the extra is missing.
        TapeError: no tape, or one that does not tell enough.
    """
    check_record(options)
    if options.record:
        return _record(options)
    names, path = names_of(options), page_path(options)
    if any(find_spec(module) is None for module in NEEDED):
        raise UsageError(MISSING)
    measured = evidence(options.log)
    with _bar("fitting", expected_drives(names)) as show:
        found = fit(measured, names, show)
    result = numbers(options.log, found, measured.made_with)
    if path:
        write_whole(path, page(result, found))
    if options.json:
        print(json.dumps(result | {"page": str(path) if path else None}, allow_nan=False))
        return 0
    Console().print(table(result))
    print(f"page: {path}")
    return 0


def _record(options: Options) -> int:
    truth = truth_of(options)
    check_file(options.log, "LOG")
    made = {name: QUANTITIES[name].model for name in VEHICLE} | truth
    said = {"scenario": "calibration", "seed": str(options.seed), "vehicle": "ion"} | fingerprint()
    said |= {MADE + name: repr(value) for name, value in made.items()}
    part = options.log.with_name(options.log.name + ".part")
    try:
        with (
            TapeWriter(part, metadata=said, mode="inputs") as tape,
            _bar("driving", manoeuvre()[-1].until_s) as show,
        ):
            record_manoeuvre(tape, options.seed, truth, watch=show)
        part.replace(options.log)
    finally:  # Ctrl-C leaves what was there before
        part.unlink(missing_ok=True)
    print(json.dumps({"log": str(options.log)}) if options.json else f"tape: {options.log}")
    return 0


@contextmanager
def _bar(what: str, total: float) -> Iterator[Callable[[float], None]]:
    columns = (TextColumn(what), BarColumn(), TextColumn("{task.completed:.0f}"))
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=total)
        yield lambda done: progress.update(task, completed=done)
