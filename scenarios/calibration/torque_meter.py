"""A torque meter on the driveline, such as a strain-gauge shaft with telemetry. ION had none: it is
fitted for the test drive. All numbers are estimated, after instruments of that kind."""

from tape.instruments import DriveTorque
from twin import clock
from twin.sensors.sensor import generator

RATE_HZ = 100.0
NOISE_N_M = 5.0
"""One sigma of a sample: 0.5 % of the 1,000 N m that it measures up to."""
ZERO_SD_N_M = 5.0
"""Its zero drifts; it is found again where the vehicle stands."""
SCALE_SD = 0.003
"""Calibration on a bench to 0.3 %, one sigma. No drive can tell it from an error of the mass."""
_PERIOD = clock.interval(RATE_HZ)


class TorqueMeter:
    """One instrument, as one seed drew it."""

    def __init__(self, seed: int) -> None:
        self._rng = generator(seed, "torque_meter")
        self._scale = 1.0 + SCALE_SD * self._rng.standard_normal()
        self._zero_n_m = ZERO_SD_N_M * self._rng.standard_normal()

    def due(self, k: int) -> bool:
        """Whether it measures at physics step k."""
        return k % _PERIOD == 0

    def measure(self, true_n_m: float, time_ns: int) -> DriveTorque:
        """What it says of a torque [N m]."""
        error = self._zero_n_m + NOISE_N_M * self._rng.standard_normal()
        return DriveTorque(time_ns, float(self._scale * true_n_m + error))
