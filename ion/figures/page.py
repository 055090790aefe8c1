"""One page with all figures; pictures are in it, and it asks nobody for anything."""

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from string import Template
from typing import NamedTuple

from ion.style import INK, PAPER, QUIET

HEAD = "The figures of the paper, drawn again"
INTRO = (
    "Figures 6.5 to 6.13 of the chapter on ION's navigation, from our own runs and parameters. The "
    "paper's figures did not survive as numbers: what they show is repeated, not their values."
)
PAGE = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$head</title>
<style>
body { background: $paper; color: $ink; font: 16px/1.5 sans-serif; margin: 2rem auto;
  max-width: 72rem; padding: 0 1rem; }
figure { margin: 3rem 0; }
img { display: block; width: 100%; }
h2 { font-size: 1.15rem; margin: 0 0 .5rem; }
figcaption p { margin: .4rem 0; max-width: 52rem; }
.differs { color: $quiet; }
</style>
</head>
<body>
<h1>$head</h1>
<p>$intro</p>
$figures
</body>
</html>
""")
FIGURE = Template("""<figure id="fig-$name">
<h2>Fig. $name. $title</h2>
<img alt="Fig. $name: $title" src="data:image/png;base64,$data">
<figcaption><p>$shows</p><p class="differs">Where ours differs: $differs</p></figcaption>
</figure>
""")


class Drawn(NamedTuple):
    """A figure and its words."""

    name: str
    """`6.5`."""
    title: str
    shows: str
    differs: str
    png: bytes


def page(figures: Sequence[Drawn]) -> str:
    """The HTML file's text."""
    colors = {"paper": PAPER, "ink": INK, "quiet": QUIET}
    body = "".join(_figure(drawn) for drawn in figures)
    return PAGE.substitute(colors, head=escape(HEAD), intro=escape(INTRO), figures=body)


def _figure(drawn: Drawn) -> str:
    words = {name: escape(getattr(drawn, name)) for name in ("name", "title", "shows", "differs")}
    return FIGURE.substitute(words, data=b64encode(drawn.png).decode())
