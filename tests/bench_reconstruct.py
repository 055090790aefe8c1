"""How true what `ion reconstruct` makes of a tape is: `python tests/bench_reconstruct.py
[--out FOLDER] [--seed N] [--faults] [SCENARIO ...]`, a scenario as `ion drive` takes it.

Drives each, reconstructs its tape, holds the things found against the world that was drawn, drives
the reconstruction, and reconstructs that tape once more. With --faults: every fault that messages
can show, of every sensor, four kinds in four drives past a stack of bales. A table in Markdown.
The truth is used here only.
"""

import json
from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from scenarios.processor import fix_processor

fix_processor()  # before numpy loads

import numpy as np  # noqa: E402

from ion.courses import scenario_source  # noqa: E402
from ion.job import Job  # noqa: E402
from ion.map_layers import shadow  # noqa: E402
from ion.reconstruct.command import reconstruct  # noqa: E402
from ion.reconstruct.obstacles import rectangle_of  # noqa: E402
from ion.reconstruct.options import Options  # noqa: E402
from ion.recorded import recorded  # noqa: E402
from nav.messages import Floats  # noqa: E402
from scenarios.course import Course  # noqa: E402
from scenarios.planned import Thing  # noqa: E402
from scenarios.scenario_file import read_scenario  # noqa: E402
from scenarios.verdicts.shapes import bottom_m  # noqa: E402
from scenarios.verdicts.tracking import frames  # noqa: E402
from tape.reader import read  # noqa: E402
from tape.truth import TRUTH  # noqa: E402
from twin.faults import Fault, parse  # noqa: E402
from twin.world import SOFT, Obstacle  # noqa: E402

BALE = "scenarios/suites/scenes/bale.toml"
SCENARIOS = ("dead_end", "lidar_recovers", "tunnel", BALE, "nqe")
NEAR_M, FOUND_M = 10.0, 0.3
OVERHEAD_M = 1.5
"""What begins so high above the ground hangs."""
RISES_M = 0.3
"""Ground that is so much higher than where the vehicle drove past is a bank."""
STEP_M = 0.1
"""Between points of an edge."""
SENSORS = (
    "lidar_bumper", "lidar_roof", "lidar_left", "lidar_right", "radar", "sonar", "gps", "imu",
    "compass", "odometry",
)  # fmt: skip
KINDS = ("silent", "frozen", "late by 1.5", "flapping by 3")
FIRST_S, APART_S, LASTS_S = 5.0, 2.0, 10.0


class Compared(NamedTuple):
    """Things found against those that are there."""

    true: int
    """Things within 10 m of the driven path, and of those ..."""
    found: int
    """... how many have a found edge within 0.3 m."""
    missed: list[str]
    made_up: int
    """Found where nothing stands and no bank rises."""
    banks: int
    """Found where the ground rises."""
    face_m: tuple[float, float]
    """Distance of found faces that look to the path from true edges: median and 95 %."""


def main() -> None:
    """Print the tables."""
    ask = ArgumentParser(description=__doc__)
    ask.add_argument("scenarios", nargs="*")
    ask.add_argument("--out", type=Path, default=Path("runs/reconstruct"))
    ask.add_argument("--seed", type=int, default=0)
    ask.add_argument("--faults", action="store_true")
    asked = ask.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    if asked.faults:
        for kind in KINDS:
            planted(kind, asked.out, asked.seed)
        return
    print(
        "| scenario | found | made up | banks | faces m (median, 95 %) | driven again "
        "| found again | new | faults |\n|---|---|---|---|---|---|---|---|---|"
    )
    for name in asked.scenarios or SCENARIOS:
        print(row(name, asked.out, asked.seed), flush=True)


def row(name: str, out: Path, seed: int) -> str:
    """Of one scenario."""
    log = Path(Job(scenario_source(name), out).drive(seed)["log"])
    first = out / f"{log.stem}_rebuilt.toml"
    things = rebuilt(log, first)
    c = compared(log, things)
    again = Job(scenario_source(str(first)), out).drive(seed)
    second = rebuilt(Path(again["log"]), out / f"{log.stem}_twice.toml")
    kept = sum(near(thing, second) for thing in things)
    new = sum(not near(thing, things) for thing in second)
    ended = f"{again['outcome']}, {again['contacts']} contacts, {again['sim_time_s']:.0f} s"
    faults = "; ".join(read_scenario(first).faults)
    cells = (
        log.stem, f"{c.found} of {c.true}", c.made_up, c.banks,
        f"{c.face_m[0]:.2f}, {c.face_m[1]:.2f}", ended, f"{kept} of {len(things)}", new, faults,
    )  # fmt: skip
    missed = f"\nmissed: {', '.join(c.missed)}" if c.missed else ""
    return "| " + " | ".join(str(cell) for cell in cells) + " |" + missed


def rebuilt(log: Path, path: Path) -> tuple[Thing, ...]:
    """The things that `ion reconstruct` finds on a tape."""
    for made in (path, path.with_suffix(".rddf")):
        made.unlink(missing_ok=True)
    reconstruct(Options(log, path, json=True))
    return read_scenario(path).things


# ------------------------------------------------------------------ things


def compared(log: Path, things: Sequence[Thing]) -> Compared:
    """What was found of what is there."""
    course = recorded(log).course()
    path = np.array([r.message.position_m[:2] for r in read(log, TRUTH)])  # pyright: ignore
    true = [o for o in course.world.everything() if counts(o, course, path)]
    edges = [edge(shadow(o)) for o in true]
    faces = [frames(course).to_world(edge(rectangle_of(t).corners_m())) for t in things]
    found = [least(e, np.concatenate(faces)) <= FOUND_M if faces else False for e in edges]
    every = np.concatenate([edge(shadow(o)) for o in course.world.everything()])
    off = [f for f in faces if least(f, every) > FOUND_M]
    banks = sum(rises(f, course, path) for f in off)
    real = [looking(f, path) for f in faces if least(f, every) <= FOUND_M]
    gaps = np.concatenate([nearest(f, every) for f in real] or [np.zeros(1)])
    return Compared(
        len(true),
        sum(found),
        [o.name for o, is_found in zip(true, found, strict=True) if not is_found],
        len(off) - banks,
        banks,
        (float(np.median(gaps)), float(np.percentile(gaps, 95.0))),
    )


def counts(obstacle: Obstacle, course: Course, path: Floats) -> bool:
    """Whether something is to be found: near, and neither soft nor overhead."""
    x, y, _ = obstacle.center_m
    ground = float(course.world.terrain.height(np.array(x), np.array(y)))
    hangs = bottom_m(obstacle) - ground > OVERHEAD_M
    return not hangs and obstacle.kind not in SOFT and least(edge(shadow(obstacle)), path) < NEAR_M


def edge(corner_m: Floats) -> Floats:
    """Points along the edge of a polygon (k, 2), shape (n, 2)."""
    sides = []
    for a, b in zip(corner_m, np.roll(corner_m, -1, axis=0), strict=True):
        share = np.linspace(0.0, 1.0, max(int(np.hypot(*(b - a)) / STEP_M), 1) + 1)
        sides.append(a + share[:, None] * (b - a))
    return np.concatenate(sides)


def nearest(point_m: Floats, others_m: Floats) -> Floats:
    """From each point to the nearest of the others, shape (n,)."""
    return np.array([np.hypot(*(others_m - p).T).min() for p in point_m])


def least(point_m: Floats, others_m: Floats) -> float:
    """From any point to any other."""
    low, high = point_m.min(axis=0) - NEAR_M, point_m.max(axis=0) + NEAR_M
    near = others_m[((others_m > low) & (others_m < high)).all(axis=1)]
    return float(nearest(point_m, near).min()) if len(near) else np.inf


def looking(face_m: Floats, path: Floats) -> Floats:
    """The half of an edge that is nearer to the path."""
    gap = nearest(face_m, path)
    return face_m[gap <= np.median(gap)]


def rises(face_m: Floats, course: Course, path: Floats) -> bool:
    """Whether the ground there is higher than where the vehicle drove past."""
    height = course.world.terrain.height
    past = path[np.hypot(*(path - face_m.mean(axis=0)).T).argmin()]
    return float(height(*face_m.T).max() - height(*past)) > RISES_M


def near(thing: Thing, others: Sequence[Thing]) -> bool:
    """Whether another stands where this one does."""
    face = edge(rectangle_of(thing).corners_m())
    return any(rectangle_of(o).distance_m(face).min() <= FOUND_M for o in others)


# ------------------------------------------------------------------ faults


def planted(kind: str, out: Path, seed: int) -> None:
    """All sensors fail in one way, one after the other; print what was found of it."""
    word, _, size = kind.partition(" ")
    lines = [
        f"{name} {word} {size} {from_s:g}s-{from_s + LASTS_S:g}s".replace("  ", " ")
        for from_s, name in zip(FIRST_S + APART_S * np.arange(len(SENSORS)), SENSORS, strict=True)
    ]
    asked = out / f"{word}.toml"
    asked.write_text(Path(BALE).read_text() + f"faults = {json.dumps(lines)}\n")
    figures: dict[str, Any] = Job(scenario_source(str(asked)), out).drive(seed)
    path = out / f"{word}_rebuilt.toml"
    rebuilt(Path(figures["log"]), path)
    found = [parse(line, SENSORS) for line in read_scenario(path).faults]
    for line in lines:
        print(told(parse(line, SENSORS), found))
    print(f"{word}: {len(found)} found, {len(lines)} planted")


def told(fault: Fault, found: Sequence[Fault]) -> str:
    """A planted fault, and the nearest that was found of it."""
    same = [f for f in found if (f.device, f.kind) == (fault.device, fault.kind)]
    if not same:
        others = ", ".join(str(f) for f in found if f.device == fault.device)
        return f"| {fault} | not found | {others} |"
    best = min(same, key=lambda f: abs(f.begins - fault.begins))
    size = "" if fault.size is None else f", size {(best.size or 0.0) - fault.size:+.2f}"
    return f"| {fault} | {best} | begins {best.begins - fault.begins:+.2f} s{size} |"


if __name__ == "__main__":
    main()
