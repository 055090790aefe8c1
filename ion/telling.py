"""How a drive is told: a bar while it runs, a table or JSON when it has ended."""

import json
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table

from nav.route.rddf import MILE_M, MPH_MPS

if TYPE_CHECKING:
    from scenarios.episode import Episode

SHORT_M = 160.0
"""A tenth of a mile."""
EVERY = 25
"""Ticks between two looks at the bar: 0.5 s simulated, about 0.01 s of wall time."""

FILES = {"tape": "log", "map": "map"}
"""What a drive leaves, and where its result names it."""

Result = dict[str, Any]


class Bar:
    """Watches a run and shows it on standard error; a context manager."""

    def __init__(self, title: str) -> None:
        columns = ("time", "speed", "state", "gates")
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            *(TextColumn(f"{{task.fields[{name}]}}") for name in columns),
            console=Console(stderr=True),
        )
        self._task = self._progress.add_task(title, **dict.fromkeys(columns, ""))
        self._ticks = 0

    def __enter__(self) -> "Bar":
        self._progress.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._progress.stop()

    def __call__(self, episode: "Episode", records: Sequence[object]) -> None:
        """Show where the episode is."""
        del records  # Unused.
        self._ticks += 1
        if self._ticks % EVERY and episode.outcome is None:
            return
        judge, course = episode.judge, episode.course
        self._progress.update(
            self._task,
            total=len(course.waypoint_m),
            completed=judge.progress.passed,
            time=_clock(episode.time_s),
            speed=f"{episode.truth.speed_mps / MPH_MPS:4.1f} mph",
            state=episode.state.replace("_", " "),
            gates=f"{len(judge.gates.passed)}/{len(course.gates)} gates",
        )


def as_json(result: Result | list[Result]) -> str:
    """One line; numbers to a tenth of a millimetre."""
    return json.dumps(_rounded(result), allow_nan=False)


def as_asked(result: Result) -> bool:
    """Whether a drive is what its scenario's file asks of it; without one, whether it arrived."""
    if "verdicts" in result:
        return all(verdict["passed"] for verdict in result["verdicts"])
    return result["outcome"] == "finished"


def summary(results: Sequence[Result], wall_time_s: float) -> Result:
    """The counts over many results."""
    outcomes = Counter(result["outcome"] for result in results)
    failed = sorted(r["seed"] for r in results if r["outcome"] != "finished")
    return {
        "summary": True,
        "episodes": len(results),
        "finished": outcomes["finished"],
        "outcomes": dict(sorted(outcomes.items())),
        "failed_seeds": failed,
        "wall_time_s": wall_time_s,
    }


def table(result: Result) -> Table:
    """What one drive came to, for people."""
    title = f"{result['scenario']}, seed {result['seed']}"
    grid = Table(title=title, show_header=False, title_justify="left")
    grid.add_column()
    grid.add_column(overflow="fold")
    for name, text in rows(result):
        grid.add_row(name, text)
    return grid


def line(result: Result) -> str:
    """One of many drives, for people."""
    head = f"seed {result['seed']:>4}  {result['outcome']:<12}"
    if "sim_time_s" not in result:
        return f"{head}{result.get('message', '')}"
    return (
        f"{head}{_clock(result['sim_time_s'])}  {result['gates_passed']}/{result['gates_total']}"
        f" gates  {result['contacts']} contacts  {result['departures']} departures"
        f"  {_meters(result['min_clearance_m'])} clear  {result['log'] or ''}"
    )


def rows(r: Result) -> list[tuple[str, str]]:
    """What one drive came to: names and texts."""
    states = ", ".join(f"{name.replace('_', ' ')} {_clock(s)}" for name, s in r["states"].items())
    wall = f"{r['wall_time_s']:.1f} s, {r['real_time_factor']:.0f} times real time"
    return [
        ("outcome", r["outcome"]),
        ("simulated time", _clock(r["sim_time_s"])),
        ("wall time", wall),
        ("distance", way(r["distance_m"])),
        ("gates", f"{r['gates_passed']} of {r['gates_total']}"),
        ("contacts", " ".join([str(r["contacts"]), *r["contact_objects"]])),
        ("departures", str(r["departures"])),
        ("least clearance", _meters(r["min_clearance_m"])),
        ("... to gate posts", _meters(r["gate_clearance_m"])),
        ("... to tunnel walls", _meters(r["tunnel_clearance_m"])),
        ("cross track, estimated", _meters(r["cross_track_rms_m"])),
        ("cross track, true", _meters(r["true_cross_track_rms_m"])),
        ("waypoints", f"{r['waypoints_passed']} of {r['waypoints_total']}"),
        ("states", states),
        ("digest", r["digest"]),
        *((f"verdict on {v['figure']}", verdict(v)) for v in r.get("verdicts", ())),
        *(
            (name, r[key] or "not kept")
            for name, key in (("tape", "log"), ("map", "map"))
            if key in r
        ),
    ]


def way(distance_m: float) -> str:
    """In miles, or metres where it is short."""
    return f"{distance_m:.0f} m" if distance_m < SHORT_M else f"{distance_m / MILE_M:.2f} miles"


def duration(time_s: float) -> str:
    """As "2:33 min" or "9:25:44 h"."""
    minutes, seconds = divmod(round(time_s), 60)
    hours, rest = divmod(minutes, 60)
    return f"{hours}:{rest:02d}:{seconds:02d} h" if hours else f"{minutes}:{seconds:02d} min"


def verdict(v: Result) -> str:
    """Whether a figure is as it must be, for people."""
    value = f"{v['value']:.4g}" if isinstance(v["value"], float) else v["value"]
    found = "not measured" if v["value"] is None else value
    return f"{'passed' if v['passed'] else 'FAILED'}: {found}, expected {v['expected']}"


def _clock(seconds: float) -> str:
    return f"{int(seconds // 60):2d}:{seconds % 60:04.1f}"


def _meters(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f} m"


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 4)
    if isinstance(value, dict):
        return {key: _rounded(inner) for key, inner in value.items()}
    return [_rounded(inner) for inner in value] if isinstance(value, list) else value
