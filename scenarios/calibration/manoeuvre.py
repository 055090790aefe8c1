"""`manoeuvre.toml` as a timeline of actuator targets."""

from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from math import pi, sin

import msgspec

from nav.messages import ActuatorTargets, Gear


class Phase(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """What is asked of the actuators from the end of the phase before."""

    name: str
    until_s: float
    steering_rad: float = 0.0
    throttle: float = 0.0
    brake: float = 0.0
    period_s: float = 0.0
    """Of a sine with the amplitude `steering_rad`; 0: it is held."""


class _Manoeuvre(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    phase: tuple[Phase, ...]


@cache
def manoeuvre() -> tuple[Phase, ...]:
    """The whole minute."""
    text = (files("scenarios.calibration") / "manoeuvre.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=_Manoeuvre).phase


def targets(phases: Sequence[Phase], time_ns: int) -> ActuatorTargets:
    """What is asked at a time; after the end, what was asked last."""
    time_s, last = time_ns * 1e-9, len(phases) - 1
    now = next((i for i, phase in enumerate(phases) if time_s < phase.until_s), last)
    phase, begin_s = phases[now], phases[now - 1].until_s if now else 0.0
    return ActuatorTargets(
        time_ns, _steering_rad(phase, time_s - begin_s), phase.throttle, phase.brake, Gear.HIGH
    )


def _steering_rad(phase: Phase, since_s: float) -> float:
    swing = sin(2.0 * pi * since_s / phase.period_s) if phase.period_s else 1.0
    return swing * phase.steering_rad
