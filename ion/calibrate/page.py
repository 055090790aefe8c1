"""The page of a fit; its picture is in it, and it asks nobody for anything."""

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from string import Template

from ion.calibrate.numbers import Result
from ion.calibrate.picture import picture
from ion.calibrate.table import HEADS, caption, rows
from ion.style import GRID, INK, PAPER, QUIET, png
from scenarios.calibration.fit import Fit

PAGE = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Calibration: $log</title>
<style>
body { background: $paper; color: $ink; font: 16px/1.5 sans-serif; margin: 2rem auto;
  max-width: 72rem; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin: 0 0 1rem; }
img { display: block; width: 100%; }
table { border-collapse: collapse; }
th, td { border-top: 1px solid $grid; padding: .15rem 1.2rem .15rem 0; text-align: left;
  vertical-align: top; }
th, .quiet { color: $quiet; font-weight: normal; }
</style>
</head>
<body>
<h1>Calibration: $log</h1>
<table>$rows</table>
<p class="quiet">$caption</p>
<img alt="Measured and predicted curves, before and after" src="data:image/png;base64,$picture">
</body>
</html>
""")


def page(result: Result, fit: Fit) -> str:
    """The HTML file's text."""
    head = _row("th", HEADS)
    return PAGE.substitute(
        paper=PAPER, ink=INK, grid=GRID, quiet=QUIET,
        log=escape(result["log"]), caption=escape(caption(result)),
        rows=head + "".join(_row("td", row) for row in rows(result)),
        picture=b64encode(png(picture(fit))).decode(),
    )  # fmt: skip


def _row(tag: str, cells: Sequence[str]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"
