"""The page of all checks; pictures are in it, and it asks nobody for anything."""

from base64 import b64encode
from html import escape
from string import Template

from ion.style import DECIDED, GRID, INK, PAPER, PASSED, QUIET, png
from ion.truth.plot import plot
from ion.truth.words import row
from scenarios.truth import Check

INTRO = (
    "Each part of the twin is held against a measurement, a published number, or, where neither "
    "was found, a range that we hold for plausible. The grade says which: only what is measured or "
    "published is evidence."
)
PAGE = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>How true is the twin?</title>
<style>
body { background: $paper; color: $ink; font: 16px/1.5 sans-serif; margin: 2rem auto;
  max-width: 80rem; padding: 0 1rem; }
table { border-collapse: collapse; }
td, th { border-top: 1px solid $grid; padding: .2rem 1rem .2rem 0; text-align: left;
  vertical-align: top; }
.yes { color: $good; } .no { color: $bad; font-weight: bold; }
.quiet { color: $quiet; }
figure { display: inline-block; margin: 1rem 1rem 1rem 0; width: 38rem; vertical-align: top; }
figure img { width: 100%; }
</style>
</head>
<body>
<h1>How true is the twin?</h1>
<p>$intro</p>
<p>$count</p>
<table>
<tr><th>check</th><th>twin</th><th>allowed</th><th>off</th><th>grade</th><th>from</th><th></th></tr>
$rows
</table>
$figures
</body>
</html>
""")


def page(found: dict[str, Check]) -> str:
    """The HTML file's text."""
    holding = sum(check.holds for check in found.values())
    colors = {"paper": PAPER, "ink": INK, "quiet": QUIET, "grid": GRID}
    return PAGE.substitute(
        colors, good=PASSED, bad=DECIDED, intro=INTRO,
        count=f"{holding} of {len(found)} hold.",
        rows="\n".join(_row(name, check) for name, check in found.items()),
        figures="\n".join(_figure(name, check) for name, check in found.items() if check.curve),
    )  # fmt: skip


def _row(name: str, check: Check) -> str:
    _, title, twin, allowed, off, source = (escape(text) for text in row(name, check))
    what = f'<a href="#{name}">{title}</a>' if check.curve else title
    remark = f'<br><span class="quiet">{escape(check.remark)}</span>' if check.remark else ""
    mood, word = ("yes", "holds") if check.holds else ("no", "does not hold")
    cells = (what + remark, twin, allowed, off, check.grade, source)
    inside = "".join(f"<td>{cell}</td>" for cell in cells)
    return f'<tr>{inside}<td class="{mood}">{word}</td></tr>'


def _figure(name: str, check: Check) -> str:
    data, title = b64encode(png(plot(check))).decode(), escape(check.title)
    return (
        f'<figure id="{name}"><img alt="{title}" src="data:image/png;base64,{data}">'
        f"<figcaption>{title}</figcaption></figure>"
    )
