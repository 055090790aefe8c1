"""What is searched: all that a scenario's file varies, as a unit cube, and seeds."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import msgspec

from scenarios.distribution import Distribution, Number, quantile
from scenarios.scenario_file import ScenarioFile
from scenarios.settings import FRICTION, names
from scenarios.variation import JUDGE, SHIFT


class Point(NamedTuple):
    """One drive of a scenario: nothing is drawn any more but what the seed draws."""

    scenario: ScenarioFile
    """With these values in its `[vary]`."""
    values: dict[str, Number]
    """What was searched; without them the point is the scenario as it is."""
    seed: int


@dataclass(frozen=True)
class Space:
    """A scenario, and the seeds that it may be driven with."""

    scenario: ScenarioFile
    seeds: tuple[int, ...]

    @property
    def varied(self) -> dict[str, Distribution]:
        """By name, each an axis of the cube."""
        vary = self.scenario.vary
        return {name: v for name, v in vary.items() if isinstance(v, Distribution)}

    def point(self, place: Sequence[float], seed: int) -> Point:
        """What lies at a place in the cube: shares of all draws, 0 to 1."""
        pairs = zip(self.varied.items(), place, strict=True)
        return self.at({name: quantile(v, float(share)) for (name, v), share in pairs}, seed)

    def at(self, values: dict[str, Number], seed: int, **more: Any) -> Point:
        """With these values; varied names that are not among them stay as ION has them.

        Args:
            values: by name.
            seed: of the drive.
            more: fields of the scenario that are other than in its file.
        """
        fixed = {n: v for n, v in self.scenario.vary.items() if n not in self.varied}
        vary = {"vary": fixed | values}
        return Point(msgspec.structs.replace(self.scenario, **vary, **more), values, seed)


def usual(scenario: ScenarioFile) -> dict[str, Number]:
    """What the numbers that vary have where nothing sets them. Of the officials' patience and the
    gear shift, which have none, the middle of what is drawn."""
    course = scenario.drawn_course(0)
    known = names(course.vehicle) | {FRICTION: course.world.friction}
    varied = {n: v for n, v in scenario.vary.items() if isinstance(v, Distribution)}
    no_one = (*JUDGE, SHIFT)
    return {n: quantile(v, 0.5) if n in no_one else known[n] for n, v in varied.items()}
