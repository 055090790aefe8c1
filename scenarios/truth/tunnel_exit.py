"""What a tunnel leaves: the error across the corridor after it, as the course is driven."""

import numpy as np

from scenarios.episode import Episode
from scenarios.nqe import build
from scenarios.truth.check import Check, Curve, Range

BEFORE_S, AFTER_S, FROM_S = 70.0, 20.0, 30.0
HALF_WIDTH_M = 0.762


def after_the_tunnel() -> Check:
    """True error of the estimate across the vehicle's way, from the tunnel's entry on."""
    course = build(0)
    episode = Episode(course, 0)
    time_s, error_m, left_s = list[float](), list[float](), 0.0
    was = ""
    while episode.time_s < (left_s or BEFORE_S) + AFTER_S and episode.outcome is None:
        episode.tick()
        left_s = episode.time_s if was == "tunnel_mode" and episode.state != was else left_s
        was = episode.state
        if episode.estimate is not None and episode.time_s > FROM_S:
            truth, believed = episode.truth, episode.estimate.position_m
            place = episode.judge.frames.to_world(believed[None, :])[0]
            gap = place - truth.position_m[:2]
            across = np.cos(truth.heading_rad) * gap[1] - np.sin(truth.heading_rad) * gap[0]
            time_s.append(episode.time_s)
            error_m.append(float(across))
    margin = float(course.half_width_m.min()) - HALF_WIDTH_M
    lines = {"true lateral error [m]": np.array(error_m)}
    after = [abs(e) for t, e in zip(time_s, error_m, strict=True) if t > left_s]
    return Check(
        title="After the NQE's tunnel: largest true lateral error within 20 s", unit="m",
        twin=max(after, default=np.inf), allowed=Range(0.0, margin), grade="estimated",
        source="the margin of the NQE's narrowest corridor beside the vehicle",
        curve=Curve(np.array(time_s), "time [s]", "", lines),
    )  # fmt: skip
