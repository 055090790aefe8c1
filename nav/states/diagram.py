"""A diagram of the machine (Fig. 6.3), drawn from the table by which it runs."""

from collections.abc import Iterator

from nav.states.transitions import TRANSITIONS
from nav.states.watchdog import MAIN_STATES


def mermaid() -> str:
    """The states and their transitions in Mermaid, which GitHub draws."""
    return "\n".join(["stateDiagram-v2", *(f"    {line}" for line in _lines())]) + "\n"


def _lines() -> Iterator[str]:
    yield f"[*] --> {MAIN_STATES[0]}"
    for state, transitions in TRANSITIONS.items():
        for target, guard in transitions:
            yield f"{state} --> {target}: {guard.__name__.replace('_', ' ')}"
    for state in TRANSITIONS:
        if state != MAIN_STATES[0]:
            yield f"{state} --> {MAIN_STATES[0]}: watchdog"
