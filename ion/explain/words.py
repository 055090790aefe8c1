"""A decision in words, for titles and tables."""

from math import degrees

from ion.explain.explanation import Explanation
from nav.angles import wrapped

NOT_IN_FORCE = "the steering controller is not in force here: it only says what it would do"


def title(why: Explanation, name: str) -> str:
    """What a picture is of: place, state and reason, decision."""
    note = "" if why.in_force or not why.considered else f" ({NOT_IN_FORCE})"
    direction = rf"$\theta_D$ {decided(why)}; " if why.considered else ""
    return f"{name}, {why.time_s:.1f} s\n{entered(why)}\n{direction}{speed(why)}{note}"


def entered(why: Explanation) -> str:
    """The state, and why it was entered."""
    return f"{state(why)}: {why.reason}"


def state(why: Explanation) -> str:
    """The state's name as the paper writes it."""
    return why.state.replace("_", " ").title().replace("Path Point", "Path-Point")


def decided(why: Explanation) -> str:
    """The steering controller's direction, and on which boundary."""
    if why.considered is None:
        return "-"
    decision = why.considered.decision
    would = "" if why.in_force else "would be "
    return f"{would}{from_heading(why, decision.theta_D)}, {decision.selected} boundary"


def speed(why: Explanation) -> str:
    """The set point and what it is limited by."""
    rules = why.plan.by_rules
    limit = f", limited by {rules.limited_by}" if rules else ""
    return f"{why.plan.speed_mps:.2f} m/s{limit}"


def known(why: Explanation) -> str:
    """How well the ego state is known, one sigma, and which sensors do not help."""
    s, ego = why.situation, why.situation.ego
    helpless = [f"{name} refused for {seconds:.1f} s" for name, seconds in why.refused_s.items()]
    helpless += [f"{name} failed" for name in (*s.health.failed, *s.health.lost)]
    return "; ".join([
        f"±{ego.position_sd_m:.2f} m an axis, ±{degrees(ego.heading_sd_rad):.1f}°",
        f"the last fix {s.gps_lost_s:.1f} s ago", *helpless,
    ])  # fmt: skip


def from_heading(why: Explanation, theta_rad: float) -> str:
    """An angle from the vehicle's heading, with its side."""
    value = round(degrees(wrapped(theta_rad - why.situation.ego.heading_rad)), 1)
    side = "left of" if value > 0.0 else "right of" if value < 0.0 else "off"
    return f"{abs(value):.1f}° {side} the heading"
