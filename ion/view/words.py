"""What is going on, in plain words."""

from ion.view.timeline import Moment
from nav.messages import Decision, DirectCommand, FollowPath, UnitOperation


def state_name(state: str) -> str:
    """As the paper writes it."""
    return state.replace("_", " ").title().replace("Path Point", "Path-Point")


def sentence(moment: Moment) -> str:
    """Markdown: the state and why; what is done; how it stands."""
    decision = moment.decision
    if decision is None:
        return "**Starting**: no decision yet."
    head = f"**{state_name(decision.state)}** since {moment.since_s:.1f} s: {decision.reason}."
    return "\n\n".join([head, _does(moment, decision), _stands(moment, decision)])


def _does(moment: Moment, decision: Decision) -> str:
    command = moment.command
    if isinstance(command, UnitOperation):
        return f"Unit operation: {command.gear.name.lower()}, {command.remaining_m:.1f} m to go."
    if isinstance(command, DirectCommand):
        return f"It stands: {command.name.replace('_', ' ')} {command.sensor}".strip() + "."
    if not isinstance(command, FollowPath):
        return "No command yet."
    way = f"Selected the {decision.selected} boundary" if decision.selected else "On its path"
    return f"{way}, {_pace(decision)}." + _new(decision)


def _pace(decision: Decision) -> str:
    """How the set point compares with the speed limit."""
    share = decision.speed_mps / max(decision.V0_mps, 0.1)
    word = "at the limit" if share > 0.9 else "slower" if share > 0.5 else "slow"
    return f"{word}: set point {decision.speed_mps:.1f} of {decision.V0_mps:.1f} m/s"


def _new(decision: Decision) -> str:
    return f" New local path: {decision.replanned}." if decision.replanned else ""


def _stands(moment: Moment, decision: Decision) -> str:
    side = "left" if decision.cross_track_m > 0.0 else "right"
    speed = f"{moment.ego.speed_mps:.1f} m/s, " if moment.ego else ""
    return (
        f"{speed}{abs(decision.cross_track_m):.1f} m {side} of the smooth path, "
        f"waypoint {decision.waypoint}. Free: {decision.D1_m:.0f} m straight ahead, "
        f"{decision.D_m:.0f} m along the path."
    )
