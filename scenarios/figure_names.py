"""The figures that a verdict may be about."""

from difflib import get_close_matches

from scenarios.behaviour import Behaviour
from scenarios.bounds import TABLES

EPISODE = ("outcome", "sim_time_s", "digest")
JUDGED = (
    "distance_m", "max_speed_mps", "gates_passed", "gates_total", "gates_missed", "contacts",
    "contact_objects", "grounded", "max_tilt_rad", "departures", "min_clearance_m",
    "gate_clearance_m", "tunnel_clearance_m", "tunnel_offset_rms_m", "tunnel_offset_max_m",
    "cross_track_rms_m", "true_cross_track_rms_m", "waypoints_passed", "waypoints_total", "states",
)  # fmt: skip
"""Of `scenarios.verdicts`."""
NAMES = (*EPISODE, *JUDGED, *Behaviour().figures())


def check_figure(name: str) -> None:
    """Refuse what is no figure.

    Raises:
        ValueError: it is unknown; lists those that exist, or the likeliest.
    """
    table = name.partition(".")[0]
    if name not in NAMES and (table not in TABLES or "." not in name):
        near = get_close_matches(name, NAMES, 3, 0.5) or NAMES
        raise ValueError(f"no figure; there are {', '.join(near)}, and others; see docs/figures.md")
