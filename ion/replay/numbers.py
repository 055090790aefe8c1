"""A comparison as plain values, for JSON and for other processes."""

import math
from typing import Any

from ion.replay.comparison import Comparison, First

Result = dict[str, Any]
Unlike = dict[str, tuple[str, str]]


def numbers(comparison: Comparison, unlike: Unlike) -> Result:
    """What a replay came to."""
    moved = comparison.moved.items()
    return {
        "ticks": comparison.ticks,
        "identical": comparison.first is None,
        "first_difference": comparison.first and _first(comparison.first),
        "platform": _platform(unlike, comparison.tolerance),
        "fields": {name: {**vars(each), "most": _finite(each.most)} for name, each in moved},
    }


def _first(first: First) -> Result:
    found = first.difference
    return {
        "tick": first.tick,
        "time_s": first.time_s,
        "field": found.field,
        "index": found.index and list(found.index),
        "logged": _finite(found.logged),
        "now": _finite(found.now),
    }


def _platform(unlike: Unlike, tolerance: float) -> Result:
    differs = {name: {"logged": there, "now": here} for name, (there, here) in unlike.items()}
    return {"same": not differs, "tolerance": tolerance, "differs": differs}


def _finite(value: Any) -> Any:
    """JSON knows no infinity."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
