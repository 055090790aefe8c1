"""The twin driven by what a tape's actuators did: what its sensors should have felt."""

from typing import NamedTuple

import numpy as np

from scenarios.calibration.evidence import Evidence, Floats, Inputs
from scenarios.calibration.quantities import STEERING_ZERO, Values
from scenarios.calibration.vehicle import START, settings
from twin.body import CONTROL_STEPS
from twin.plant import Plant
from twin.vehicle import WHEEL_RADIUS_M


class Felt(NamedTuple):
    """What the sensors should have said, as in `Evidence`; the wheels' spin signed, in [rad/s]."""

    imu: Floats
    wheels: Floats
    gps: Floats


class Retraced(Plant):
    """The Ranger whose steering, driveline and brakes do as recorded."""

    def __init__(self, values: Values, inputs: Inputs) -> None:
        model, drivetrain, gain = settings(values)
        super().__init__(model, START, 0, drivetrain=drivetrain, steering_gain=gain)
        force_n = inputs.torque_n_m / WHEEL_RADIUS_M
        steering_rad = inputs.steering_rad - values.get(STEERING_ZERO, 0.0)
        self._recorded = np.stack([steering_rad, force_n, inputs.brake], axis=1).tolist()

    def _control(self) -> None:
        velocity = self._velocity()
        self._hold(*self._recorded[self.k // CONTROL_STEPS])
        self._drag(velocity)
        self._soften(abs(self._ahead(velocity)))


def retrace(evidence: Evidence, values: Values) -> Felt:
    """Drive the whole tape again, from the standing start to its end."""
    plant = Retraced(values, evidence.inputs)
    imu, wheels, gps = list[Floats](), list[Floats](), list[float]()
    felt, turned, moved = (
        set(series.step.tolist()) for series in (evidence.imu, evidence.wheels, evidence.gps)
    )
    for k in range(1, evidence.steps + 1):
        plant.step()
        if k in felt:
            imu.append(np.concatenate(plant.imu()))
        if k in turned:
            wheels.append(plant.wheel_speed_radps)
        if k in moved:
            gps.append(float(np.hypot(*plant.site_velocity("gps")[0][:2])))
    return Felt(np.array(imu), np.array(wheels), np.array(gps)[:, None])
