"""Fig. 6.7: how the focus rules work on one decision."""

from matplotlib.figure import Figure

from ion.explain.picture import draw as explained
from ion.explain.words import title
from ion.figures.drives import Drives

NAME = "6.7"
TITLE = "The example of the focus rules"
SHOWS = (
    "One decision in the two-car section of the NQE, as `ion explain` draws it: the world and "
    "both boundaries, the scanning distances, d_max - Delta, and the adjusted curves from whose "
    "candidate sets theta_D is selected; beside them how strongly each rule fired."
)
DIFFERS = (
    "The paper's example is not given in numbers; this one is ours. Corridor edges are "
    "boundaries too, and the persistence rules take part in Delta, which the paper says in words "
    "only."
)


def draw(drives: Drives) -> Figure:
    """The decision that evaded most."""
    why = drives.two_cars.recorder.chosen
    assert why is not None
    return explained(why, title(why, "NQE, two cars"))
