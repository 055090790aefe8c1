"""The arguments of `ion bench`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from tyro.conf import Positional, arg

from ion.courses import scenario_source
from ion.errors import UsageError
from scenarios.seeds import MAX_SEED

if TYPE_CHECKING:
    from scenarios.course import Course


@dataclass(frozen=True)
class Options:
    """Which drive is measured, and for how long."""

    scenario: Annotated[Positional[str], arg(metavar="[SCENARIO]")] = "nqe"
    """Name of a scenario."""
    seed: Annotated[int, arg(metavar="N")] = 0
    """Of the drive."""
    seconds: Annotated[float, arg(metavar="SECONDS")] = 60.0
    """How long it is driven, simulated, after two seconds that are not counted."""
    json: bool = False
    """One JSON object on standard output instead of a table."""


def checked(options: Options) -> tuple["Course", int]:
    """What is driven, and for how many ticks of 20 ms; all that can be wrong is found first.

    Raises:
        UsageError: an option is wrong.
    """
    from scenarios.vehicles import DUBINS
    from twin.simulator import TICK_S

    if not 0 <= options.seed <= MAX_SEED:
        raise UsageError(f"--seed {options.seed}: expected a whole number from 0 to {MAX_SEED}")
    if not TICK_S <= options.seconds < float("inf"):
        raise UsageError(f"--seconds {options.seconds:g}: expected {TICK_S:g} or more")
    course = scenario_source(options.scenario).course(options.seed)
    if course.vehicle == DUBINS:
        raise UsageError(f"scenario {options.scenario!r}: moves without MuJoCo, expected another")
    return course, round(options.seconds / TICK_S)
