"""A decision in plain words, and what other terms would make of it."""

from math import degrees

from ion.explain.numbers import Numbers
from ion.view.decide.decisions import Found
from nav.angles import wrapped

SAME_DEG, SAME_MPS = 0.05, 0.005
"""What is nearer than this is told as the same."""


def told(found: Found) -> str:
    """Markdown."""
    lines = [f"**{found.was['time_s']:.1f} s:** {_decided(found.was)}."]
    if found.would:
        lines.append(f"**Tuned:** {_changed(found.was, found.would)}.")
    if not found.same:
        lines.append("*This code decides otherwise than the tape says.*")
    return "\n\n".join(lines)


def _decided(n: Numbers) -> str:
    boundary = f", {n['selected']} boundary" if n["selected"] else ""
    limit = f", limited by {n['speed_limited_by']}" if n["speed_limited_by"] else ""
    return f"steers {_side(n)}{boundary}; {n['speed_mps']:.2f} m/s{limit}"


def _changed(was: Numbers, would: Numbers) -> str:
    turned = abs(degrees(wrapped(_theta(would) - _theta(was))))
    faster = abs(would["speed_mps"] - was["speed_mps"])
    if turned < SAME_DEG and faster < SAME_MPS and was["selected"] == would["selected"]:
        return "it would have decided the same"
    steers = f"would have steered {_side(would)} instead of {_side(was)}"
    if turned < SAME_DEG:
        steers = "would have steered the same"
    speed = f"asked for {would['speed_mps']:.2f} instead of {was['speed_mps']:.2f} m/s"
    if faster < SAME_MPS:
        speed = "asked for the same speed"
    return f"{steers}, and {speed}{_other_boundary(was, would)}"


def _other_boundary(was: Numbers, would: Numbers) -> str:
    before, now = (n["selected"] or "no" for n in (was, would))
    return "" if before == now else f", by the {now} boundary instead of the {before} one"


def _theta(n: Numbers) -> float:
    """Of the steering controller; of a state that does not ask it, of the path."""
    return n["decision_rad"] if n["decision_rad"] is not None else n["path_direction_rad"]


def _side(n: Numbers) -> str:
    angle = round(degrees(wrapped(_theta(n) - n["heading_rad"])), 1)
    return f"{abs(angle):.1f}° {'left' if angle > 0.0 else 'right' if angle < 0.0 else 'ahead'}"
