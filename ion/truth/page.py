"""The page of all checks."""

from html import escape

from ion.html import document, image, mood, paragraph, row
from ion.style import png
from ion.truth.plot import plot
from ion.truth.words import row as told
from scenarios.truth import Check

INTRO = (
    "Each part of the twin is held against a measurement, a published number, or, where neither "
    "was found, a range that we hold for plausible. The grade says which: only what is measured or "
    "published is evidence."
)
HEADS = ("check", "twin", "allowed", "off", "grade", "from", "")
STYLE = """figure { display: inline-block; margin: 1rem 1rem 1rem 0; width: 36rem; }
"""


def page(found: dict[str, Check]) -> str:
    """The HTML file's text."""
    holding = sum(check.holds for check in found.values())
    rows = "\n".join(_row(name, check) for name, check in found.items())
    figures = "\n".join(_figure(name, check) for name, check in found.items() if check.curve)
    body = (
        f"{paragraph(INTRO)}{paragraph(f'{holding} of {len(found)} hold.')}"
        f"<table>{row(*HEADS, tag='th')}{rows}</table>{figures}"
    )
    return document("How true is the twin?", body, STYLE)


def _row(name: str, check: Check) -> str:
    _, title, twin, allowed, off, source = (escape(text) for text in told(name, check))
    what = f'<a href="#{name}">{title}</a>' if check.curve else title
    remark = f'<br><span class="quiet">{escape(check.remark)}</span>' if check.remark else ""
    cells = (what + remark, twin, allowed, off, check.grade, source)
    inside = "".join(f"<td>{cell}</td>" for cell in cells)
    word = "holds" if check.holds else "does not hold"
    return f'<tr>{inside}<td class="{mood(check.holds)}">{word}</td></tr>'


def _figure(name: str, check: Check) -> str:
    picture = image(png(plot(check)), check.title)
    return f'<figure id="{name}">{picture}<figcaption>{escape(check.title)}</figcaption></figure>'
