"""Any scenario as a `dm_env.Environment`, for anybody's agent to drive the truck.

A step is 20 ms, as the navigator's. The twin is stepped as in an episode; `physics`, for the viewer
of dm_control, only looks at it.
"""

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any

import dm_env
import numpy as np
from dm_env import specs
from numpy.typing import NDArray

from nav.messages import ActuatorTargets, Gear
from nav.route.smooth_path import project, smooth_path
from nav.route.waypoints import Waypoints
from scenarios.course import Course
from scenarios.failing import failing
from scenarios.observations import Heard, Observation, kinds
from scenarios.parameter_files import parameters_of
from scenarios.scenario import check_options, scenario_names
from scenarios.vehicles import VEHICLES
from scenarios.verdicts import Judge
from twin.simulator import Simulator

if TYPE_CHECKING:
    from dm_control.mujoco import Physics

CONTACT, DEPARTURE = -100.0, -100.0
"""Reward of what ends an episode badly; a metre of way along the route is 1 (our choice)."""


class ActionError(ValueError):
    """An action that no vehicle could take; says what would be one."""


def load(scenario: str, seed: int = 0, faults: Sequence[str] = (), **options: Any) -> "Environment":
    """A scenario by its name, as `ion drive` takes it.

    Args:
        scenario: such as `nqe`.
        seed: of the first episode; each reset draws the next.
        faults: lines as `--fault` takes them.
        options: what the scenario takes beyond the seed.

    Raises:
        ValueError: there is no such scenario, or no such option or fault.
    """
    if scenario not in scenario_names():
        there_are = ", ".join(scenario_names())
        raise ValueError(f"scenario {scenario!r} is unknown; there are: {there_are}")
    check_options(scenario, options)
    build = import_module(f"scenarios.{scenario}.course").build
    return Environment(lambda number: failing(build(number, **options), faults), seed)


class Environment(dm_env.Environment):
    """One vehicle on one course, driven by an agent.

    Reward: metres gained along the smooth path of the route in this step; `CONTACT` and `DEPARTURE`
    when the verdict is that. Discount: 0 when the judge ends the drive, but 1 at the time limit,
    which is no property of the world (the convention of dm_env).
    """

    def __init__(self, build: Callable[[int], Course], seed: int = 0) -> None:
        """`build` draws the course of a seed; the first reset draws that of `seed`."""
        self._build, self._next_seed = build, seed
        self._over = True
        self._begin()

    # ------------------------------------------------------------ dm_env.Environment

    def reset(self) -> dm_env.TimeStep:
        """Begin a new episode: the next seed's."""
        if not self._fresh:
            self._begin()
        self._over, self._fresh = False, False
        return dm_env.restart(self._observation())

    def step(self, action: NDArray[np.float64]) -> dm_env.TimeStep:
        """Drive for 20 ms under targets: steering [rad], throttle, brake, gear (0 R to 3 H).

        After the end, and on a fresh environment, it begins anew and ignores the action.

        Raises:
            ActionError: not four finite numbers within `action_spec`.
        """
        if self._over:
            return self.reset()
        before_m, targets = self._here.arc_m, self._targets(action)
        self._heard.take(self.simulator.advance(targets))
        truth = self.simulator.truth()
        self.judge.observe(truth, None, None)
        self._here = project(self._path, truth.position_m[:2], self._here.index)
        return self._time_step(self._here.arc_m - before_m)

    def action_spec(self) -> specs.BoundedArray:  # pyright: ignore  (dm_env has no types)
        """Steering, throttle, brake, gear; the gear is rounded to the nearest."""
        return self._actions

    def observation_spec(self) -> dict[str, specs.Array]:  # pyright: ignore
        """Of each device its newest message, and how old it is; see `scenarios.observations`."""
        found: dict[str, specs.Array] = {}
        for name, kind in kinds(self.vehicle).items():
            found[name] = specs.Array(kind.shape, np.float64, f"{name}: {kind.says}")
            found[f"{name}_age_s"] = specs.BoundedArray((), np.float64, 0.0, np.inf, f"{name} age")
        return found

    # ------------------------------------------------------------ for who looks on

    @property
    def time_s(self) -> float:
        """Simulated time, [s]."""
        return self.simulator.time_ns * 1e-9

    @property
    def control_timestep(self) -> float:
        """Time of a step, [s]; a method in dm_control's own environments, a number here."""
        return 0.02

    @property
    def physics(self) -> "Physics":
        """The model and the data of the twin, for dm_control's viewer and for pictures.

        Raises:
            ImportError: dm_control is not installed.
            TypeError: the vehicle is not simulated in MuJoCo.
        """
        if not isinstance(self.simulator, Simulator):
            raise TypeError(f"{self.course.name}: its vehicle is a point, without MuJoCo")
        from scenarios.physics_view import view

        if self._physics is None:
            self._physics = view(self.simulator.plant.data)
        return self._physics

    # ------------------------------------------------------------ inside

    def _begin(self) -> None:
        seed, self._next_seed = self._next_seed, self._next_seed + 1
        self.seed, self.course = seed, self._build(seed)
        vehicle = VEHICLES[self.course.vehicle]
        self.vehicle = parameters_of(self.course.vehicle).vehicle
        course = self.course
        self._path = smooth_path(
            Waypoints(course.waypoint_m, course.half_width_m, course.speed_mps)
        )
        self.simulator = vehicle.twin(self.course.world, seed, frozenset())
        self.judge = Judge(self.course, outline=vehicle.outline)
        self._heard = Heard(self.vehicle)
        self._actions = _actions(self.vehicle.steering.limit_rad)
        self._here = project(self._path, self.simulator.truth().position_m[:2], 0)
        self._physics: Any = None
        self._fresh = True

    def _observation(self) -> Observation:
        return self._heard.observation(self.simulator.time_ns)

    def _time_step(self, gained_m: float) -> dm_env.TimeStep:
        outcome, seen = self.judge.outcome, self._observation()
        if outcome is None:
            return dm_env.transition(gained_m, seen)
        self._over = True
        if outcome == "timeout":
            return dm_env.truncation(gained_m, seen)
        lost = {"contact": CONTACT, "departure": DEPARTURE}.get(outcome, 0.0)
        return dm_env.termination(gained_m + lost, seen)

    def _targets(self, action: NDArray[np.float64]) -> ActuatorTargets:
        spec, wanted = self._actions, np.asarray(action, np.float64)
        if wanted.shape != spec.shape or not np.isfinite(wanted).all():
            raise ActionError(f"action {action!r}: expected four finite numbers: {spec.name}")
        if (wanted < spec.minimum).any() or (wanted > spec.maximum).any():
            low, high = spec.minimum.tolist(), spec.maximum.tolist()
            raise ActionError(f"action {wanted.tolist()}: expected it within {low} and {high}")
        steering, throttle, brake, gear = wanted.tolist()
        return ActuatorTargets(self.simulator.time_ns, steering, throttle, brake, Gear(round(gear)))


def _actions(limit_rad: float) -> specs.BoundedArray:
    low, high = (-limit_rad, 0.0, 0.0, 0.0), (limit_rad, 1.0, 1.0, 3.0)
    return specs.BoundedArray((4,), np.float64, low, high, "steering_rad throttle brake gear")
