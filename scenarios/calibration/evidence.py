"""What a tape says of a test drive, as arrays: what the actuators did, what the sensors felt."""

from collections.abc import Iterable
from math import sqrt
from os import PathLike
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.messages import GpsFix, GpsQuality, ImuSample, VehicleState
from tape.errors import TapeError
from tape.instruments import MEASURED, DriveTorque
from tape.reader import metadata, read
from tape.record import PREFIX
from twin import clock
from twin.body import CONTROL_STEPS

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

STAND_S = 2.5
"""So long the vehicle stands at the start: there the torque meter's zero is read."""
STAND_STEPS = int(STAND_S * clock.STEPS_PER_SECOND)
STANDING_MPS, DRIVEN_MPS = 0.3, 3.0
CONTROL_NS = clock.time_ns(CONTROL_STEPS)
MADE = "made_with."
"""Of the tape's metadata: what is below it the twin was told."""
NEEDED = {
    ImuSample: "IMU",
    VehicleState: "drive-by-wire",
    GpsFix: "GPS",
    DriveTorque: "drive torque",
}


class Inputs(NamedTuple):
    """What the actuators did, at every control step of the plant; shape (n,) each."""

    steering_rad: Floats
    brake: Floats
    torque_n_m: Floats
    """Of all wheels together, the meter's zero taken away."""


class Series(NamedTuple):
    """One kind of sensor."""

    step: Ints
    """Shape (n,): the physics step of each sample."""
    value: Floats
    """Shape (n, channels)."""


class Evidence(NamedTuple):
    """A test drive, from its first step to its last."""

    steps: int
    inputs: Inputs
    input_sd: tuple[float, float, float]
    """One sigma of the white noise on each of the inputs."""
    imu: Series
    """Angular rate x, y, z [rad/s], specific force x, y, z [m/s^2]."""
    wheels: Series
    """Speed of the six wheels [m/s], unsigned."""
    gps: Series
    """Speed over ground [m/s]."""
    made_with: dict[str, float]
    """What the twin was told that made the tape; empty for a truck's."""


def evidence(path: str | PathLike[str]) -> Evidence:
    """Read a tape.

    Raises:
        TapeError: no tape, or one that lacks a sensor, or does not begin with the vehicle at rest.
    """
    heard: dict[Any, list[Any]] = {kind: [] for kind in NEEDED}
    for item in read(path, (PREFIX, MEASURED)):
        if type(item.message) in heard:
            heard[type(item.message)].append(item.message)
    for kind, name in NEEDED.items():
        if not heard[kind]:
            raise TapeError(
                f"{path}: no {name} on it; expected a tape of a test drive, as"
                " ion calibrate LOG --record makes one"
            )
    said = metadata(path).items()
    made_with = {n.removeprefix(MADE): float(v) for n, v in said if n.startswith(MADE)}
    result = _evidence(path, heard, made_with)
    told = (*result.inputs, result.imu.value, result.wheels.value, result.gps.value)
    if not all(np.isfinite(values).all() for values in told):
        raise TapeError(f"{path}: a sensor says what is no number; expected numbers only")
    return result


def _evidence(path: Any, heard: dict[Any, list[Any]], made_with: dict[str, float]) -> Evidence:
    origin_ns = min(messages[0].time_ns for messages in heard.values()) // CONTROL_NS * CONTROL_NS
    steps = {kind: _steps(messages, origin_ns) for kind, messages in heard.items()}
    last = int(min(s[-1] for s in steps.values()))
    wheels = Series(steps[VehicleState], np.array([m.wheel_speed_mps for m in heard[VehicleState]]))
    if wrong := _wrong(steps.values(), wheels):
        raise TapeError(f"{path}: {wrong}")
    imu = np.array([(*m.angular_rate_radps, *m.acceleration_mps2) for m in heard[ImuSample]])
    good = np.array([m.quality is not GpsQuality.NONE for m in heard[GpsFix]])
    speed = np.array([[np.hypot(*m.velocity_mps[:2])] for m in heard[GpsFix]])
    return Evidence(
        last,
        *_inputs(heard, steps, last),
        _until(last, steps[ImuSample], imu),
        _until(last, *wheels),
        _until(last, steps[GpsFix][good], speed[good]),
        made_with,
    )


def _wrong(steps: Iterable[Ints], wheels: Series) -> str:
    """Why this is no test drive, or nothing."""
    if any((np.diff(step) <= 0).any() for step in steps):
        return "a sensor's time does not go on; expected one clock for the whole tape"
    if not (wheels.value[wheels.step < STAND_STEPS].mean() < STANDING_MPS):
        return f"expected the vehicle at rest for {STAND_S} s at the start"
    if not (wheels.value.max() > DRIVEN_MPS):
        return f"the vehicle hardly moves; expected a test drive at more than {DRIVEN_MPS} m/s"
    return ""


def _steps(messages: list[Any], origin_ns: int) -> Ints:
    """The physics steps at which messages were measured."""
    time_ns = np.array([m.time_ns for m in messages]) - origin_ns
    return np.rint(time_ns * (clock.STEPS_PER_SECOND * 1e-9)).astype(np.int64)


def _until(last: int, step: Ints, value: Floats) -> Series:
    kept = (step > 0) & (step <= last)
    return Series(step[kept], value[kept])


def _inputs(
    heard: dict[Any, list[Any]], steps: dict[Any, Ints], last: int
) -> tuple[Inputs, tuple[float, float, float]]:
    """What is said at the end of a control step was in force during it."""
    ends = np.arange(CONTROL_STEPS, last + CONTROL_STEPS, CONTROL_STEPS)
    state, meter = steps[VehicleState], steps[DriveTorque]
    torque = np.array([m.torque_n_m for m in heard[DriveTorque]])
    torque -= torque[meter < STAND_STEPS].mean()
    said = (
        (state, np.array([m.steering_rad for m in heard[VehicleState]])),
        (state, np.array([m.brake for m in heard[VehicleState]])),
        (meter, torque),
    )
    steering, brake, drive = (np.interp(ends, *one) for one in said)
    a, b, c = (_noise(*one) for one in said)
    return Inputs(steering, brake, drive), (a, b, c)


def _noise(step: Ints, said: Floats) -> float:
    """One sigma at control steps that disturbs as much as the noise of the samples does.

    Of a median, as what is recorded moves now and then; a second difference of white noise has six
    times its variance.
    """
    sd = 1.4826 * float(np.median(np.abs(np.diff(said, 2)))) / sqrt(6.0)
    return sd * sqrt(float(np.median(np.diff(step))) / CONTROL_STEPS)
