"""The figures that a verdict may be about."""

from difflib import get_close_matches

from scenarios.behaviour import Behaviour
from scenarios.bounds import TABLES, Bound, Expected

EPISODE = ("outcome", "sim_time_s", "digest")
JUDGED = (
    "distance_m", "max_speed_mps", "gates_passed", "gates_total", "gates_missed", "contacts",
    "contact_objects", "grounded", "max_tilt_rad", "departures", "min_clearance_m",
    "gate_clearance_m", "tunnel_clearance_m", "tunnel_offset_rms_m", "tunnel_offset_max_m",
    "cross_track_rms_m", "true_cross_track_rms_m", "waypoints_passed", "waypoints_total", "states",
)  # fmt: skip
"""Of `scenarios.verdicts`."""
NAMES = (*EPISODE, *JUDGED, *Behaviour().figures())
WORDS = ("outcome", "digest")
LISTS = (
    "gates_missed", "contact_objects", "transitions", "states_entered", "transitions_unknown",
)  # fmt: skip
"""All others are numbers."""
EXAMPLES = {
    "a word": '"finished" or the like',
    "a list of words": '{ has = ["..."] }',
    "a number": "one, or { least = 0.0, most = 1.0 }",
}


def check_figure(name: str, expected: Expected) -> None:
    """Refuse what is no figure, and what it can never be.

    Raises:
        ValueError: it is unknown; lists those that exist, or the likeliest. Or what is expected of
            it is of another kind; says which is right.
    """
    _known(name)
    right, found = _right(name), _kind(expected)
    if found != right:
        raise ValueError(f"is {right}, expected {EXAMPLES[right]}; found {found}")


def _right(name: str) -> str:
    return "a word" if name in WORDS else "a list of words" if name in LISTS else "a number"


def _kind(expected: Expected) -> str:
    if isinstance(expected, Bound):
        listed, ordered = expected.has or expected.lacks, (expected.least, expected.most)
        if listed and ordered != (None, None):
            return "words and a number"
        return "a list of words" if listed else "a number"
    return "a word" if isinstance(expected, str) else "a number"


def _known(name: str) -> None:
    table = name.partition(".")[0]
    if name in TABLES or (name not in NAMES and table not in TABLES):
        near = get_close_matches(name, NAMES, 3, 0.5) or NAMES
        raise ValueError(f"no figure; there are {', '.join(near)}, and others; see docs/figures.md")
