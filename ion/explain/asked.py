"""From a tape and a time to the decision that was in force then."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from ion.errors import UsageError
from ion.explain.explanation import Explanation, explanation_of
from ion.replay.scans import check_scans
from nav.messages import Decision
from scenarios.difference import difference
from scenarios.replay import navigator_of, replay, tolerance
from tape.reader import span_ns

Shown = Callable[[float], None]
"""Is told how far the replay is, [s]."""


class Answer(NamedTuple):
    """The decision, and whether the replay went as the tape says."""

    explanation: Explanation
    difference: str
    """What this decision says otherwise than the tape's; empty where nothing."""
    first_difference: str
    """What the replay said otherwise first, and when; empty where nothing."""


def decision_at(log: Path, at_s: float, shown: Shown) -> Answer:
    """Run the present navigator on a tape up to a time; the last decision until then.

    Raises:
        UsageError: no decision was in force then, or the tape lacks the scans to run on.
        TapeError: no tape, or a damaged one.
    """
    check(log, at_s)
    navigator, slack = navigator_of(log), tolerance(log)
    here = first = ""
    for tick in replay(log, navigator):
        if tick.time_ns > at_s * 1e9:
            break
        said = difference(tick, slack)
        first = first or (said and f"at {tick.time_ns * 1e-9:.2f} s {said}")
        if any(isinstance(report, Decision) for report in tick.outputs.reports):
            here = said
        shown(tick.time_ns * 1e-9)
    found = explanation_of(navigator)
    if found is None:
        raise UsageError(f"{log}: the replay comes to no decision until {at_s:g} s; {first}")
    return Answer(found, here, first)


def check(log: Path, at_s: float) -> None:
    """Refuse what cannot be answered, before anything is run.

    Raises:
        UsageError, TapeError: as `decision_at`.
    """
    end_s = span_ns(log)[1] * 1e-9
    if not at_s <= end_s:
        raise UsageError(f"--at {at_s:g}: the tape {log} ends at {end_s:.2f} s")
    first_s = check_scans(log)
    if first_s is None:
        raise UsageError(f"{log}: has no decision on it")
    if at_s < first_s:
        raise UsageError(f"--at {at_s:g}: the first decision on {log} is at {first_s:.2f} s")
