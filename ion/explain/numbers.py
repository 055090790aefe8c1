"""The numbers of a decision, as arrays for programs."""

from typing import Any

from ion.explain.asked import Answer
from ion.explain.explanation import Explanation
from nav.messages import Floats
from nav.states.obstacle_avoidance import Considered

Numbers = dict[str, Any]
CURVES = (
    "theta_rad", "distance_real_m", "distance_safe_m", "distance_touch_m", "deduction_m",
    "adjusted_real_m", "adjusted_safe_m", "candidates_real", "candidates_safe",
    "criterion_real_m", "criterion_safe_m", "goal_rad", "previous_rad", "decision_real_rad",
    "decision_safe_rad", "decision_rad", "selected", "select_rules", "exploring",
    "breakpoints_rad",
)  # fmt: skip
"""In a state that does not ask the steering fuzzy controller most of them are null."""


def numbers(answer: Answer) -> Numbers:
    """All of them; angles in the route frame N, counter-clockwise from east, not wrapped."""
    why = answer.explanation
    s, plan, rules = why.situation, why.plan, why.plan.by_rules
    curves = _curves(why, why.considered) if why.considered else _directions(why)
    return {
        "time_s": why.time_s,
        "state": why.state,
        "reason": why.reason,
        "guard": why.guard,
        "in_force": why.in_force,
        **curves,
        "heading_rad": s.ego.heading_rad,
        "position_m": s.ego.position_m.tolist(),
        "position_sd_m": s.ego.position_sd_m,
        "heading_sd_rad": s.ego.heading_sd_rad,
        "gps_lost_s": s.gps_lost_s,
        "refused_s": why.refused_s,
        "sensors_failed": list(s.health.failed),
        "sensors_lost": list(s.health.lost),
        "waypoint": s.waypoint,
        "cross_track_m": s.cross_track_m,
        "path_direction_rad": plan.decision_rad,
        "pathpoint_m": _list(why.pathpoint_m),
        "replanned": plan.replanned,
        "v_mps": s.ego.speed_mps,
        "V0_mps": s.V0_mps,
        "D1_m": plan.D1_m,
        "D_m": plan.D_m,
        "speed_rules": speed_rules(why),
        "speed_terms_mps": rules.terms_mps if rules else None,
        "speed_limited_by": rules.limited_by if rules else None,
        "speed_mps": plan.speed_mps,
        "replay_difference": answer.difference,
        "replay_first_difference": answer.first_difference,
    }


def speed_rules(why: Explanation) -> dict[str, dict[str, float]] | None:
    """Strengths of the rules A and T in words; None where other rules set the speed."""
    rules = why.plan.by_rules
    return rules and {"A": rules.anti_collision_rules, "T": rules.safe_steering_rules}


def _directions(why: Explanation) -> Numbers:
    """What there is of the curves' keys in a state without them."""
    plan = why.plan
    there = {"decision_rad": plan.decision_rad, "selected": plan.selected}
    return dict.fromkeys(CURVES) | {"goal_rad": why.situation.goal_rad} | there


def _curves(why: Explanation, found: Considered) -> Numbers:
    decision, distances = found.decision, found.distances
    values = (
        found.theta_rad.tolist(), distances.real_m.tolist(), distances.safe_m.tolist(),
        distances.touch_m.tolist(), decision.deduction_m.tolist(),
        (distances.real_m - decision.deduction_m).tolist(),
        (distances.safe_m - decision.deduction_m).tolist(),
        decision.candidates_real.tolist(), decision.candidates_safe.tolist(),
        decision.criterion_real_m, decision.criterion_safe_m, found.goal_rad,
        why.previous_rad, decision.theta_RD, decision.theta_SD, decision.theta_D,
        decision.selected, decision.select_rules, decision.situation.exploring,
        list(decision.breakpoints_rad),
    )  # fmt: skip
    return dict(zip(CURVES, values, strict=True))


def _list(array: Floats | None) -> list[Any] | None:
    return None if array is None else array.tolist()
