"""The arguments of `ion calibrate`, as typed, and what is wrong with them."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from ion.errors import UsageError
from ion.out_file import check_file
from scenarios.calibration.quantities import FITTED, QUANTITIES, VEHICLE, check


@dataclass(frozen=True)
class Options:
    """Which tape, and what is to be found; or which tape is to be made."""

    log: Annotated[Positional[Path], arg(metavar="LOG")]
    """A tape of the calibration manoeuvre."""
    fit: Annotated[str, arg(metavar="NAME,...")] = ",".join(FITTED)
    """What is fitted, of mass, friction, steering, cg_height and springs; rolling and brakes always
    are."""
    json: bool = False
    """One JSON object on standard output."""
    out: Annotated[Path | None, arg(metavar="FILE")] = None
    """Where the page goes (HTML). Default: beside the tape; with --json none."""
    record: bool = False
    """Make the tape LOG instead: the twin drives the manoeuvre."""
    seed: int = 0
    """Of --record: draws the errors of the sensors."""
    truth: Annotated[str, arg(metavar="NAME=VALUE,...")] = ""
    """Of --record: what the vehicle is like where it is not as its model."""


def names_of(options: Options) -> tuple[str, ...]:
    """What is to be fitted.

    Raises:
        UsageError: an unknown name, or none.
    """
    names = tuple(name.strip() for name in options.fit.split(",") if name.strip())
    _check("--fit", names)
    if not names:
        raise UsageError(f"--fit names no parameter; known are {', '.join(VEHICLE)}")
    return names


def truth_of(options: Options) -> dict[str, float]:
    """What the vehicle of a new tape is like.

    Raises:
        UsageError: an unknown name, no number, or one beyond where it is looked for.
    """
    pairs = [pair.partition("=") for pair in options.truth.split(",") if pair.strip()]
    _check("--truth", (name.strip() for name, _, _ in pairs))
    return {name.strip(): _number(name.strip(), text) for name, _, text in pairs}


def page_path(options: Options) -> Path | None:
    """Where the page goes, or None.

    Raises:
        UsageError: it would replace the tape, or it cannot be written.
    """
    if options.json and not options.out:
        return None
    path = options.out or options.log.with_suffix(".html")
    if path.resolve() == options.log.resolve():
        raise UsageError(f"--out {path}: is the tape itself; expected another file")
    check_file(path)
    return path


def check_record(options: Options) -> None:
    """Refuse what does not go together.

    Raises:
        UsageError: options of the one use with the other.
    """
    if not options.record and (options.truth or options.seed):
        raise UsageError("--seed and --truth belong to --record, which makes a tape")
    if options.record and options.out:
        raise UsageError("--out belongs to a fit; --record only makes the tape LOG")
    if options.seed < 0:
        raise UsageError(f"--seed {options.seed}: expected 0 or more")


def _check(option: str, names: Iterable[str]) -> None:
    try:
        check(names)
    except ValueError as error:
        raise UsageError(f"{option}: {error}") from error


def _number(name: str, text: str) -> float:
    q = QUANTITIES[name]
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not isfinite(value) or not q.least <= value <= q.most:
        limits = f"{q.least:g} to {q.most:g} {q.unit}".rstrip()
        raise UsageError(f"--truth {name}={text}: expected a number from {limits}")
    return value
