"""The proving ground: the twin's vehicle alone on a plane, driven by a plain driver."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import mujoco
import numpy as np

import models
from nav.messages import ActuatorTargets, Gear
from scenarios.truth.check import Floats
from twin import clock
from twin.plant import Plant
from twin.vehicle import WHEEL_RADIUS_M, WHEELS

FRICTION = 0.8
"""Of dry dirt (estimated)."""
TICK_S = 0.02
Strip = tuple[float, float, float]
"""x of its middle, half its length along x, its height, [m]."""


def plane(
    friction: float = FRICTION,
    pitch_rad: float = 0.0,
    roll_rad: float = 0.0,
    strips: Sequence[Strip] = (),
) -> mujoco.MjModel:
    """The vehicle on a plane that rises ahead by `pitch_rad` and to the left by `roll_rad`."""
    spec = mujoco.MjSpec.from_file(models.path())
    spec.worldbody.add_geom(
        name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], friction=[friction, 0, 0]
    )
    for k, (x, half, height) in enumerate(strips):
        spec.worldbody.add_geom(
            name=f"strip_{k}", type=mujoco.mjtGeom.mjGEOM_BOX, pos=[x, 0.0, 0.0],
            size=[half, 3.0, height], friction=[friction, 0, 0],
        )  # fmt: skip
    model = spec.compile()
    down = -np.sin(pitch_rad), -np.sin(roll_rad) * np.cos(pitch_rad)
    model.opt.gravity[:] = 9.81 * np.array([*down, -np.cos(pitch_rad) * np.cos(roll_rad)])
    return model


class Moment(NamedTuple):
    """What is recorded every 20 ms."""

    time_s: float
    x_m: float
    y_m: float
    speed_mps: float
    heading_rad: float
    roll_rad: float
    yaw_rate_radps: float
    ahead_mps2: float
    left_mps2: float
    up_mps2: float
    steering_rad: float
    throttle: float
    brake: float


class Rig:
    """A vehicle on the proving ground, and what it has done so far."""

    def __init__(self, model: mujoco.MjModel | None = None, gear: Gear = Gear.HIGH) -> None:
        self.plant = Plant(model or plane(), (0.0, 0.0, 0.0, 0.0), 0, gear=gear)
        self.gear = gear
        self.moments: list[Moment] = []

    @property
    def time_s(self) -> float:
        """Simulated time, [s]."""
        return self.plant.k * clock.STEP_S

    def push(self, speed_mps: float) -> "Rig":
        """Let it roll ahead at a speed from now on."""
        model, data = self.plant.model, self.plant.data
        data.qvel[model.joint("ranger_free").dofadr[0]] = speed_mps
        for wheel in WHEELS:
            data.qvel[model.joint(f"{wheel}_spin").dofadr[0]] = speed_mps / WHEEL_RADIUS_M
        mujoco.mj_forward(model, data)
        return self

    def tick(self, steering_rad: float = 0.0, throttle: float = 0.0, brake: float = 0.0) -> Moment:
        """Drive for 20 ms under targets."""
        now = clock.time_ns(self.plant.k)
        self.plant.apply(now, ActuatorTargets(now, steering_rad, throttle, brake, self.gear))
        for _ in range(6):
            self.plant.step()
        self.moments.append(self._moment())
        return self.moments[-1]

    def drive(self, seconds: float, **targets: float) -> "Rig":
        """Drive for some seconds under the same targets."""
        for _ in range(round(seconds / TICK_S)):
            self.tick(**targets)
        return self

    def until(self, over: Callable[[Moment], bool], most_s: float, **targets: float) -> "Rig":
        """Drive under the same targets until something is so, but not longer than `most_s`."""
        for _ in range(round(most_s / TICK_S)):
            if over(self.tick(**targets)):
                break
        return self

    def cruise(self, seconds: float, speed_mps: float, steering_rad: float = 0.0) -> "Rig":
        """Hold a speed."""
        driver = Cruise()
        for _ in range(round(seconds / TICK_S)):
            throttle, brake = driver.pedals(speed_mps, self.plant.speed_mps)
            self.tick(steering_rad, throttle, brake)
        return self

    def of(self, name: str, last_s: float | None = None) -> Floats:
        """A column of what was recorded, of the last seconds only if so asked."""
        moments = self.moments if last_s is None else self.moments[-round(last_s / TICK_S) :]
        return np.array([getattr(moment, name) for moment in moments])

    def _moment(self) -> Moment:
        truth, (rate, force) = self.plant.truth(), self.plant.imu()
        x, y, _ = truth.position_m.tolist()
        ahead, left, up = force.tolist()
        applied = self.plant.applied
        return Moment(
            self.time_s, x, y, truth.speed_mps, truth.heading_rad, truth.roll_rad, float(rate[2]),
            ahead, left, up, applied.steering_rad, applied.throttle, applied.brake,
        )  # fmt: skip


class Cruise:
    """A plain speed controller: proportional and integral."""

    def __init__(self, integral: float = 0.0) -> None:
        self.integral = integral
        """Of who has settled at v [m/s]: about 0.12 v."""

    def pedals(self, wanted_mps: float, speed_mps: float) -> tuple[float, float]:
        """Throttle and brake."""
        error = wanted_mps - speed_mps
        self.integral = min(max(self.integral + TICK_S * error, -2.0), 2.0)
        effort = 0.5 * error + 0.2 * self.integral
        return min(max(effort, 0.0), 1.0), min(max(-0.5 * effort - 0.2, 0.0), 1.0)
