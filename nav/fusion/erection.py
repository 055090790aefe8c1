"""The dynamic error of a vertical gyro's roll and pitch, as far as the vehicle knows its cause.

Such a gyro erects its vertical slowly towards the apparent one, which every acceleration tilts.
In a long bend that is a degree and more, and ground looks like an obstacle. The navigator knows
its own accelerations, so it can follow the error: de/dt = (apparent - true - e) / T.
"""

from dataclasses import dataclass

GRAVITY_MPS2 = 9.81


@dataclass
class Erection:
    """What the accelerations so far have done to the gyro's vertical."""

    time_s: float
    """T, of the device."""
    roll_rad: float = 0.0
    pitch_rad: float = 0.0

    def follow(self, sideward_mps2: float, forward_mps2: float, dt_s: float) -> None:
        """Let an acceleration act for `dt_s`: to the left it lifts the left side in appearance,
        forward it lifts the nose."""
        share = min(dt_s / self.time_s, 1.0)
        self.roll_rad += share * (sideward_mps2 / GRAVITY_MPS2 - self.roll_rad)
        self.pitch_rad += share * (-forward_mps2 / GRAVITY_MPS2 - self.pitch_rad)
