"""One page with all figures."""

from collections.abc import Sequence
from html import escape
from string import Template
from typing import NamedTuple

from ion.html import document, image, paragraph

HEAD = "The figures of the paper, drawn again"
INTRO = (
    "Figures 6.5 to 6.13 of the chapter on ION's navigation, from our own runs and parameters. The "
    "paper's figures did not survive as numbers: what they show is repeated, not their values."
)
FIGURE = Template("""<figure id="fig-$name">
<h2>Fig. $name. $title</h2>
$image
<figcaption><p>$shows</p><p class="quiet">Where ours differs: $differs</p></figcaption>
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
    body = "\n".join(_figure(drawn) for drawn in figures)
    return document(HEAD, paragraph(INTRO) + body)


def _figure(drawn: Drawn) -> str:
    words = {name: escape(getattr(drawn, name)) for name in ("name", "title", "shows", "differs")}
    return FIGURE.substitute(words, image=image(drawn.png, f"Fig. {drawn.name}: {drawn.title}"))
