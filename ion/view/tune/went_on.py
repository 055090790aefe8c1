"""The rest of a run as tuned, beside how it was: in the scene and in words."""

import numpy as np

from ion.style import DECIDED
from ion.view.canvas import Canvas
from ion.view.shapes import segments
from ion.view.timeline import Timeline
from ion.view.tune.rest import RestOfRun, Told
from ion.view.words import state_name
from scenarios.what_if import Progress

TRACK, RAISED_M, EVERY = "/what_if", 0.12, 5
"""Every fifth place is drawn: 0.5 s."""


def draw(canvas: Canvas, told: list[Told]) -> None:
    """The true trajectory as tuned."""
    place = np.array([p.position_m for p in _all(told)][::EVERY]).reshape(-1, 3)
    canvas.lines(f"{TRACK}/track", segments(place + np.array([0.0, 0.0, RAISED_M])), DECIDED, 4.0)


def words(rest: RestOfRun, timeline: Timeline, outcome: str) -> str:
    """How far it is, and how it went.

    Args:
        rest: what is driven.
        timeline: of the tape.
        outcome: of the tape's drive; empty when it was killed.
    """
    assert rest.task is not None
    last, from_s = rest.told[-1], rest.task.time_s
    if last.trouble:
        return f"Cannot be driven again: {last.trouble}"
    if not last.went_on:
        return f"Driving it again up to this moment: {last.reached_s:.0f} of {from_s:.0f} s."
    now = last.went_on[-1]
    head = f"**As tuned**, from {from_s:.1f} s on (red): "
    if now.outcome is None:
        return f"{head}{state_name(now.state)} at {now.time_s:.0f} s, {now.speed_mps:.1f} m/s."
    was = f"**As it was:** {outcome or 'cut off'} at {timeline.end_s:.1f} s."
    return f"{head}{now.outcome} at {now.time_s:.1f} s. {was} {_apart(rest, timeline)}"


def _apart(rest: RestOfRun, timeline: Timeline) -> str:
    """How far the two drives got from each other, at equal times."""
    tuned = _all(rest.told)
    true = timeline.true.between(tuned[0].time_s - 0.05, timeline.end_s)
    if not len(true):
        return ""
    at = np.array([p.time_s for p in tuned])
    both = at <= true[-1, 0]
    place = np.array([p.position_m[:2] for p in tuned])[both]
    gaps = [np.interp(at[both], true[:, 0], true[:, k + 1]) - place[:, k] for k in (0, 1)]
    most = float(np.hypot(*gaps).max(initial=0.0))
    return f"At equal times they are up to {most:.1f} m apart."


def _all(told: list[Told]) -> list[Progress]:
    return [progress for one in told for progress in one.went_on]
