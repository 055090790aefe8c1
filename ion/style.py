"""How all pictures look: one paper, one ink, and a colour for each thing."""

from io import BytesIO

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

PAPER, SAND, EDGE, INK = "#fbfaf7", "#f0e8d6", "#d8c9a6", "#33322e"
GRID, QUIET = "#e5e1d8", "#8b877d"
"""Of lines in the background, and of words that explain."""
PASSED, MISSED, AHEAD = "#2f7d4f", "#c0392b", "#a5a89f"
SEEN, HARD, TUNNEL = "#e0701f", "#77736b", "#8fa3b8"
SPEED_MAP, TRACK = "viridis", "#21918c"
REAL, SAFE = "#34568b", "#2a9d8f"
"""Of the real and the safe boundary, and of all that is decided on them."""
DECIDED, GOAL = "#c0392b", "#8e44ad"
"""theta_D with the chosen path, and phi."""
STATES = {
    "path_point_keeping": "#9fbf9f",
    "obstacle_avoidance": "#e0701f",
    "tunnel_mode": "#8fa3b8",
    "robotic_operations": "#8e44ad",
    "rollback": "#c0392b",
    "road_following": "#d8b04a",
    "alarm": "#33322e",
}
"""Of the states of Fig. 6.3."""
DPI = 150


def new_figure(width_in: float, height_in: float) -> Figure:
    """An empty picture."""
    figure = Figure((width_in, height_in), layout="constrained", facecolor=PAPER)
    FigureCanvasAgg(figure)
    return figure


def png(figure: Figure) -> bytes:
    """The picture as a file's content."""
    content = BytesIO()
    figure.savefig(content, dpi=DPI, format="png")
    return content.getvalue()


def plain(axes: Axes, title: str = "") -> None:
    """Axes of a plot: quiet lines, no box around it."""
    axes.set_facecolor(PAPER)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(QUIET)
    axes.tick_params(colors=INK, labelsize=8.5, color=QUIET)
    axes.grid(color=GRID, linewidth=0.7)
    axes.set_axisbelow(True)
    head(axes, title)


def head(axes: Axes, title: str) -> None:
    """A title at the left."""
    axes.set_title(title, loc="left", color=INK, fontsize=10.5, fontweight="bold")
