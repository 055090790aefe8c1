"""What all pages have alike: one look; pictures are in them, and they ask nobody for anything."""

from base64 import b64encode
from html import escape
from string import Template

from ion.style import DECIDED, GRID, INK, PAPER, PASSED, QUIET

DOCUMENT = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
body { background: $paper; color: $ink; font: 16px/1.5 sans-serif; margin: 2rem auto;
  max-width: 76rem; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin: 0; }
h2 { font-size: 1.15rem; margin: 2.5rem 0 .5rem; }
img { display: block; max-width: 100%; }
figure { margin: 3rem 0; }
figcaption p { margin: .4rem 0; max-width: 52rem; }
table { border-collapse: collapse; margin: 1rem 0; }
th, td { border-top: 1px solid $grid; padding: .15rem 1.2rem .15rem 0; text-align: left;
  vertical-align: top; overflow-wrap: anywhere; }
th { color: $quiet; font-weight: normal; }
code { background: $grid; padding: .1rem .4rem; }
.good { color: $good; }
.bad { color: $bad; font-weight: bold; }
.quiet { color: $quiet; }
$style</style>
</head>
<body>
<h1>$title</h1>
$body
</body>
</html>
""")
COLORS = {
    "paper": PAPER, "ink": INK, "quiet": QUIET, "grid": GRID, "good": PASSED, "bad": DECIDED,
}  # fmt: skip


def document(title: str, body: str, style: str = "") -> str:
    """The file's text.

    Args:
        title: its heading, as plain text.
        body: HTML, of which `good`, `bad` and `quiet` are classes that may be used.
        style: CSS beyond what all pages have.
    """
    return DOCUMENT.substitute(COLORS, title=escape(title), body=body, style=style)


def image(png: bytes, alt: str) -> str:
    """A picture."""
    return f'<img alt="{escape(alt)}" src="data:image/png;base64,{b64encode(png).decode()}">'


def paragraph(text: str, mood: str = "") -> str:
    """A text, of a class."""
    return f'<p class="{mood}">{escape(text)}</p>' if mood else f"<p>{escape(text)}</p>"


def row(*texts: str, tag: str = "td", mood: str = "") -> str:
    """A row of a table, of plain texts."""
    cells = "".join(f"<{tag}>{escape(text)}</{tag}>" for text in texts)
    return f'<tr class="{mood}">{cells}</tr>' if mood else f"<tr>{cells}</tr>"


def mood(good: bool) -> str:
    """The class of what is as it should be, or not."""
    return "good" if good else "bad"
