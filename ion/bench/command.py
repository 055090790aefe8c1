"""`ion bench`: drive for a while, measure, and tell what it costs."""

import json
import pickle
import sys
from collections.abc import Iterable
from dataclasses import asdict

from rich.console import Console
from rich.progress import track
from rich.table import Table

from ion.bench import embree
from ion.bench.figures import Figures, figures
from ion.bench.options import Options, checked
from ion.bench.parts import shares
from ion.bench.race import Slice, cut, drive_s, race
from ion.errors import UsageError
from scenarios.course import Course
from scenarios.episode import Episode
from twin.simulator import Simulator

WARM_UP_TICKS = 100
"""Compiled code is loaded, the vehicle moves off: 2 s."""


def bench(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: an option is wrong, or the drive ends before anything is measured.
    """
    course, ticks = checked(options)
    if not embree.is_installed():
        print(f"ion: {embree.MISSING}", file=sys.stderr)
    found = measured(course, options.seed, ticks)
    if options.json:
        print(json.dumps(asdict(found), allow_nan=False))
    else:
        Console().print(_table(found))
    return 0


def measured(course: Course, seed: int, ticks: int) -> Figures:
    """Drive so many ticks of 20 ms after a warm-up; then the same again, part by part.

    Raises:
        UsageError: the drive ends before anything is measured.
    """
    episode = Episode(course, seed)
    drive_s(episode, WARM_UP_TICKS)
    again: Episode = pickle.loads(pickle.dumps(episode))
    simulator = episode.simulator
    assert isinstance(simulator, Simulator)  # all but the one that was refused
    each = cut(ticks)
    slices = list(_shown(race(episode, simulator, each, embree.is_installed()), len(each)))
    if not slices:
        raise UsageError(f"{course.name}: {episode.outcome} too early, expected a longer drive")
    return figures(each, slices, shares(again, sum(each[: len(slices)])))


def _shown(slices: Iterable[Slice], count: int) -> Iterable[Slice]:
    """The same, with a bar that moves where somebody looks."""
    console = Console(stderr=True)
    quiet = not console.is_terminal
    return track(slices, "measuring", count, console=console, transient=True, disable=quiet)


def _table(found: Figures) -> Table:
    embree_over_ours = found.embree_over_ours
    table = Table("figure", "value", "unit")
    table.add_row("full loop over bare MuJoCo", f"{found.full_over_bare:.2f}", "")
    table.add_row("real time factor", f"{found.real_time_factor:.1f}", "")
    ratio = "-" if embree_over_ours is None else f"{embree_over_ours:.2f}"
    table.add_row("a LIDAR ray, Embree over ours", ratio, "")
    table.add_row("a LIDAR ray, ours", f"{found.lidar_us_per_ray:.3f}", "us", end_section=True)
    for part, spent_ms in found.parts.items():
        table.add_row(part.replace("_", " "), f"{spent_ms:.1f}", "ms a simulated second")
    return table
