"""The three drives that the figures are made of."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ion.figures.record import Recorder
from ion.figures.stretch import around
from ion.telling import Bar
from scenarios.course import Course, Floats
from scenarios.episode import Episode
from scenarios.nqe.course import build as nqe
from scenarios.random_field.course import build as random_field
from scenarios.run import run
from scenarios.small_robot.course import build as small_robot
from scenarios.verdicts.tracking import RouteFrames, frames
from twin.world import Obstacle

NQE_SEED, FIELD_SEED, ROBOT_SEED = 0, 1, 0
BEFORE_M, BEHIND_M = 222.0, 90.0
"""The stretch of the NQE around the two cars: two bends lie before them."""


class Drive(NamedTuple):
    """A drive that has ended."""

    course: Course
    frames: RouteFrames
    episode: Episode
    recorder: Recorder

    @property
    def cells_m(self) -> Floats:
        """Obstacle cells ever seen, shape (n, 2), world frame."""
        return self.frames.to_world(self.recorder.cells_m())

    @property
    def outcome(self) -> str:
        """`finished`, or one word for why not."""
        return self.episode.outcome or ""


@dataclass(frozen=True)
class Drives:
    """All that figures are drawn from, beside the parameters."""

    two_cars: Drive
    field: Drive
    robot: Drive


def drive_all() -> Drives:
    """Drive them, each with a bar on standard error."""
    whole = nqe(NQE_SEED)
    middle = np.mean([car.center_m[:2] for car in two_cars(whole)], axis=0)
    return Drives(
        _drive("NQE, two cars", around(whole, middle, BEFORE_M, BEHIND_M), NQE_SEED),
        _drive("random field", random_field(FIELD_SEED), FIELD_SEED),
        _drive("small robot", small_robot(ROBOT_SEED), ROBOT_SEED),
    )


def two_cars(course: Course) -> list[Obstacle]:
    """The boxes of the NQE's two cars."""
    return [o for o in course.world.obstacles if (o.owner or o.name).startswith("two_cars")]


def _drive(title: str, course: Course, seed: int) -> Drive:
    episode, recorder = Episode(course, seed), Recorder()
    with Bar(title) as bar:
        run(episode, None, [bar, recorder])
    return Drive(course, frames(course), episode, recorder)
