"""One episode is one object: world, twin, navigator, judge and digest. Picklable in the middle."""

from typing import Any

from nav.messages import RESET, ActuatorTargets, Decision, DirectCommand, EgoEstimate, Gear, Message
from nav.navigator import IonNavigator
from nav.parameters import Parameters
from nav.route import rddf
from scenarios.ablation import disabled_sensors
from scenarios.course import Course
from scenarios.parameter_files import parameters_of
from scenarios.vehicles import VEHICLES
from scenarios.verdicts import Judge
from tape.digest import Digest
from tape.record import Record, record
from twin.sensors.parameters import SensorParameters
from twin.truth import Truth


class Episode:
    """A pure function of (course, seed, parameters), unrolled tick by tick.

    Args:
        course: what is driven.
        seed: draws noise, sensor mounting and gear shifts.
        ablate: what is crippled, see `scenarios.ablation`.
        nav_parameters: the navigator's; those that come with it by default.
        sensors: of a vehicle in MuJoCo; its own by default.

    Raises:
        NavError: a route or parameters that the navigator refuses.
        ValueError: an unknown ablation.
    """

    def __init__(
        self,
        course: Course,
        seed: int,
        ablate: tuple[str, ...] = (),
        nav_parameters: Parameters | None = None,
        sensors: SensorParameters | None = None,
    ) -> None:
        self.course, self.seed, self.ablate = course, seed, ablate
        route = rddf.parse(course.route_text, course.route_name)
        vehicle = VEHICLES[course.vehicle]
        self.navigator = IonNavigator(nav_parameters or parameters_of(course.vehicle), route)
        silent = disabled_sensors(ablate, vehicle.lidars, vehicle.radars)
        self.simulator = vehicle.begin(course.world, seed, silent, sensors)
        path = self.navigator.high_level.route
        self.judge = Judge(course, outline=vehicle.outline, path=path)
        self.digest = Digest()
        self.truth: Truth = self.simulator.truth()
        self.targets = ActuatorTargets(0, 0.0, 0.0, 1.0, Gear.HIGH)
        self.estimate: EgoEstimate | None = None
        self.decision: Decision | None = None

    @property
    def time_s(self) -> float:
        """Simulated time, [s]."""
        return self.simulator.time_ns * 1e-9

    @property
    def state(self) -> str:
        """The navigator's state (Fig. 6.3)."""
        return self.navigator.state

    @property
    def outcome(self) -> str | None:
        """None while it runs; then `finished`, or one word for why not."""
        return self.judge.outcome

    def tick(self) -> list[Record]:
        """20 ms: what crossed the navigator's boundary, in order of delivery."""
        sensed = self.simulator.advance(self.targets)
        now = self.simulator.time_ns
        outputs = self.navigator.step(now, sensed)
        self.targets = outputs.targets
        for report in outputs.reports:
            self._remember(report)
        self.truth = self.simulator.truth()
        self.judge.observe(self.truth, self.estimate, self.decision)
        records = [record(now, m) for m in (*sensed, *outputs.reports, outputs.targets)]
        for item in records:
            self.digest.update(item)
        return records

    def _remember(self, report: Message) -> None:
        if isinstance(report, EgoEstimate):
            self.estimate = report
        elif isinstance(report, Decision):
            self.decision = report
        elif isinstance(report, DirectCommand) and report.name == RESET:
            self.simulator.reset(report.sensor)

    def figures(self) -> dict[str, Any]:
        """What the judge measured, and the digest."""
        return {
            "scenario": self.course.name,
            "seed": self.seed,
            "outcome": self.outcome,
            "sim_time_s": round(self.time_s, 3),
            **self.judge.figures(),
            **self.course.facts,
            "digest": self.digest.hex(),
        }
