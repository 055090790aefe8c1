"""What a fit found, as a table."""

from rich.table import Table

from ion.calibrate.numbers import Result
from scenarios.calibration.quantities import QUANTITIES

HEADS = ("parameter", "unit", "model", "found", "95 % interval", "made with", "off by", "what")

UNEXPLAINED = (
    "That is too much: something on this tape is not as in the model, whatever its values,"
    " and the truth may lie outside the intervals."
)


def table(result: Result) -> Table:
    """For people at a terminal; what the names mean stands on the page."""
    grid = Table(*HEADS[:-1], title=result["log"], title_justify="left", caption=caption(result))
    for *row, _ in rows(result):
        grid.add_row(*row)
    return grid


def rows(result: Result) -> list[tuple[str, ...]]:
    """A row of texts for each parameter, in the order of HEADS."""
    every = result["parameters"] | result["fitted_along"]
    return [_row(name, row, name in result["fitted_along"]) for name, row in every.items()]


def caption(result: Result) -> str:
    """How well the curves agree."""
    before, after = result["misfit"]["before"], result["misfit"]["after"]
    told = (
        f"Mean square of what is felt less what should be, in units of its noise: {before:.3g}"
        f" with the model's own values, {after:.3g} with those found."
    )
    return told if result["explained"] else f"{told} {UNEXPLAINED}"


def _row(name: str, r: Result, along: bool) -> tuple[str, ...]:
    known = r["made_with"] is not None
    made = f"{r['made_with']:.5g}" if known else "-"
    off = f"{100.0 * r['error']:+.2f} %" if r["error"] is not None else "-"
    found = f"{r['value']:.5g}" + (" (at its bound)" if r["at_bound"] else "")
    interval = f"{r['low']:.5g} to {r['high']:.5g}"
    words = QUANTITIES[name].words + (" (fitted along)" if along else "")
    return name, r["unit"], f"{r['model']:.5g}", found, interval, made, off, words
