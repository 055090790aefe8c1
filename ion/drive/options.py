"""The arguments of `ion drive`, as typed; and what they mean, checked."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from tyro.conf import Positional, UseAppendAction, arg

from ion.courses import Source, route_source, scenario_names, scenario_source
from ion.errors import UsageError
from ion.job import Job
from ion.out_file import check_folder
from ion.seeds import listed
from ion.view.options import LOCAL
from scenarios.scenario import FLAGS

if TYPE_CHECKING:
    from ion.segments import Checkpoint

Log = Literal["full", "inputs", "light", "off"]
SCENARIO_OPTIONS = ("field", "density", "first", "last")
"""Options that only some scenarios take: those of their `scenario.toml`."""


@dataclass(frozen=True)
class Options:
    """What one can ask of a drive."""

    scenario: Annotated[Positional[str | None], arg(metavar="SCENARIO")] = None
    """Name of a scenario, such as nqe. Leave it out with --route."""
    seed: Annotated[int, arg(metavar="N")] = 0
    """Draws all that the scenario leaves open, and all noise."""
    seeds: Annotated[str | None, arg(metavar="N-M")] = None
    """Many seeds, such as 0-19 or 1,4,7-9: one episode each."""
    jobs: Annotated[int, arg(metavar="N")] = 1
    """How many episodes at a time, one process each."""
    out: Annotated[Path, arg(metavar="FOLDER")] = Path("runs")
    """Where tapes and maps go."""
    json: bool = False
    """One JSON object a line on standard output instead of a table."""
    ablate: Annotated[tuple[str, ...], arg(metavar="NAME...")] = ()
    """Drive without a sensor: blind, no-sonar, no-gps, no-imu, no-lidar-roof, ...; see docs."""
    fault: Annotated[UseAppendAction[tuple[str, ...]], arg(metavar="LINE")] = ()
    """Let a device fail: 'lidar_bumper silent 120s', 'gps offset by 5 800m-900m', ...; see docs.
    May be said more than once."""
    log: Annotated[Log | None, arg(metavar="full|inputs|light|off")] = None
    """What goes on the tape: all; no /view/; no LIDAR scans; no tape. Default: full, and of many
    seeds the tapes of failures only."""
    route: Annotated[Path | None, arg(metavar="FILE")] = None
    """A route definition file (RDDF) to drive instead of a scenario."""
    resume: Annotated[Path | None, arg(metavar="FOLDER")] = None
    """Go on with a long drive from its last checkpoint: the folder of its log. Alone."""
    view: bool = False
    """Show the drive as a web page while it is driven, as `ion view` does afterwards."""
    port: Annotated[int | None, arg(metavar="N")] = None
    """With --view: of the page. Default: 8080, or the next that is free."""
    host: Annotated[str, arg(metavar="ADDRESS")] = LOCAL
    """With --view: where it can be reached from. Default: this machine only."""
    first: Annotated[int | None, arg(name="from", metavar="WAYPOINT")] = None
    """Of a route file or gc05_route: number of the waypoint to begin at."""
    last: Annotated[int | None, arg(name="to", metavar="WAYPOINT")] = None
    """Of a route file or gc05_route: number of the waypoint to end at."""
    density: Annotated[int | None, arg(metavar="N")] = None
    """Of random_field: how many circles lie about. Default: 80, beside traps and forks 40."""
    field: Annotated[str | None, arg(metavar="circles|traps|forks")] = None
    """Of random_field: what is drawn. Default: circles."""


def job_of(options: Options) -> Job:
    """The job that the options describe; all that can be wrong is found before anything starts.

    Raises:
        UsageError: an option is wrong.
        NavError: the route file is wrong.
    """
    source = replace(_source(options), faults=tuple(line.strip() for line in options.fault))
    _check_ablations(options.ablate, source)
    _check_faults(source)
    if options.view and options.seeds is not None:
        raise UsageError("--view: expected one drive, --seed N, not --seeds")
    if options.jobs < 1:
        raise UsageError(f"--jobs {options.jobs}: expected 1 or more")
    check_folder(options.out)
    few = options.seeds is not None and options.log is None
    return Job(source, options.out, options.log or "full", options.ablate, failures_only=few)


def checkpoint_of(options: Options) -> "Checkpoint":
    """What `--resume` goes on from, its log in the folder that was named.

    Raises:
        UsageError: another option beside it, no checkpoint of ours there, or one of other code.
    """
    from ion.code import code
    from ion.segments import last_checkpoint
    from scenarios.checkpoint import CheckpointError

    folder, alone = options.resume, Options(resume=options.resume, json=options.json)
    if folder is None or options != alone:
        raise UsageError("--resume: expected nothing beside it but --json: the rest is recorded")
    try:
        start = last_checkpoint(folder)
    except CheckpointError as error:
        raise UsageError(f"--resume {error}") from error
    if start.code != code():
        raise UsageError(
            f"--resume {folder}: was begun by other code or on another kind of processor; "
            "expected the same, or a drive from the start"
        )
    folder, job = folder.resolve(), start.job
    if job.path(start.seed, "").name != folder.name:
        named = job.path(start.seed, "").name
        raise UsageError(f"--resume {folder}: was renamed, expected the name {named}")
    return start._replace(job=replace(job, out=folder.parent))


def seeds_of(options: Options) -> list[int]:
    """The seeds that the options name, in order, each once.

    Raises:
        UsageError: they name none, or it is no list of seeds.
    """
    if options.seeds is None:
        return listed(str(options.seed), "--seed")
    return listed(options.seeds, "--seeds")


def _source(options: Options) -> Source:
    asked = {name: getattr(options, name) for name in SCENARIO_OPTIONS}
    given = {name: value for name, value in asked.items() if value is not None}
    if options.route is not None:
        if options.scenario is not None:
            raise UsageError(f"{options.scenario!r} and --route: expected one of them")
        for name in given:
            if name not in FLAGS:
                raise UsageError(f"--{name}: expected a scenario with it, not --route")
        return route_source(options.route, options.first, options.last)
    if options.scenario is None:
        there_are = ", ".join(scenario_names())
        raise UsageError(f"expected a scenario or --route FILE; scenarios: {there_are}")
    source = scenario_source(options.scenario, given)
    if "first" in given or "last" in given:
        source.course(0)  # refuses a stretch that ends before it begins
    return source


def _check_ablations(names: tuple[str, ...], source: Source) -> None:
    """Draws a course, to know its vehicle, only where something is to be taken away."""
    if names:
        from scenarios.ablation import disabled_sensors
        from scenarios.vehicles import VEHICLES

        vehicle = VEHICLES[source.course(0).vehicle]
        try:
            disabled_sensors(names, vehicle.lidars, vehicle.radars)
        except ValueError as error:
            raise UsageError(str(error)) from error


def _check_faults(source: Source) -> None:
    """Draws a course, to know its vehicle, only where something is to fail."""
    if source.faults:
        try:
            source.course(0)
        except ValueError as error:
            raise UsageError(f"--fault {error}") from error
