"""The arguments of `ion compare`, as typed, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from tyro.conf import Positional, UseAppendAction, arg

from ion.courses import scenario_source
from ion.errors import UsageError
from ion.out_file import check_file
from ion.seeds import listed

if TYPE_CHECKING:
    from ion.compare.variants import Comparison


@dataclass(frozen=True)
class Options:
    """Which drive, and what is varied."""

    scenario: Annotated[Positional[str], arg(metavar="SCENARIO")]
    """Name of a scenario, such as gc05_route."""
    vary: Annotated[UseAppendAction[tuple[str, ...]], arg(metavar="NAME=VALUE,...")] = ()
    """What is varied: drivetrain.shift_s=1,10,60, judge.patience_s=60,300,900,
    watchdog.still_s=60,600, ...; may be said more than once: then every combination."""
    at: Annotated[float, arg(metavar="SECONDS")] = 0.0
    """The moment from which it is varied; all variants are the same to the bit until then."""
    seeds: Annotated[str, arg(metavar="N-M")] = "0"
    """Of which drives, such as 0-9."""
    first: Annotated[int | None, arg(name="from", metavar="WAYPOINT")] = None
    """Of gc05_route: number of the waypoint to begin at."""
    last: Annotated[int | None, arg(name="to", metavar="WAYPOINT")] = None
    """Of gc05_route: number of the waypoint to end at."""
    jobs: Annotated[int, arg(metavar="N")] = 1
    """How many drives at a time, one process each."""
    out: Annotated[Path, arg(metavar="FILE")] = Path("runs/compare.png")
    """Where the picture goes (PNG)."""
    json: bool = False
    """One JSON object a variant on standard output instead of a table."""


def comparison_of(options: Options) -> "tuple[Comparison, list[int]]":
    """What is compared, and over which seeds; all that can be wrong is found first.

    Raises:
        UsageError: an option is wrong.
        NavError: a stretch that the route does not have.
    """
    from ion.compare.variants import Comparison
    from scenarios.parameter_files import parameters_of
    from scenarios.variation import parse

    seeds = listed(options.seeds, "--seeds")
    stretch = {"first": options.first, "last": options.last}
    given = {name: value for name, value in stretch.items() if value is not None}
    source = scenario_source(options.scenario, given)
    course = source.course(seeds[0])
    if course.vehicle != "ion":
        raise UsageError(f"{options.scenario!r}: is driven by another vehicle, expected ION's")
    try:
        varies = [parse(text, parameters_of(course.vehicle)) for text in options.vary]
    except ValueError as error:
        raise UsageError(f"--vary {error}") from error
    if not varies:
        raise UsageError("--vary: expected at least one, such as drivetrain.shift_s=1,10,60")
    if not 0.0 <= options.at < float("inf"):
        raise UsageError(f"--at {options.at:g}: expected seconds, 0 or more")
    if options.jobs < 1:
        raise UsageError(f"--jobs {options.jobs}: expected 1 or more")
    check_file(options.out)
    return Comparison(source, varies, options.at), seeds
