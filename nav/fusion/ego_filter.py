"""The algebra of the ego state's extended Kalman filter: predict, and update by one scalar."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from nav.messages import Floats
from nav.parameters.ego_state import EgoParameters

X, Y, HEADING, SPEED, GYRO_BIAS, COMPASS_BIAS, WHEEL_SCALE, GPS_X, GPS_Y = range(9)
"""The state. GPS_X and GPS_Y are the receiver's slow offset in units of its stated standard
deviation, first-order Gauss-Markov with variance 1, so that they follow what the receiver says."""
SIZE = 9
MIN_WAY_RATE_MPS = 1e-3
"""A standing vehicle's position still forgets a little: the covariance stays regular."""

MOST_DOUBT = 1e4
"""More, squared beside the centimetres of a fix, would leave nothing of a float's 16 digits; the
state goes all the way to the measurement nevertheless."""
COVARIANCE_S = 0.015
"""The covariance follows at least this much later: 50 Hz are enough, and half the work."""


class Row(NamedTuple):
    """A row of the measurement matrix."""

    H: Floats
    """Shape (9,)."""
    doubted: int
    """The state that is doubted when the measurement has been refused for too long."""

    def along(self, moved: Floats) -> float:
        """By how much the measurement's expectation moves with the state."""
        return float(self.H.dot(moved))


def row(*terms: tuple[int, float]) -> Row:
    """From (state, coefficient) of what is not zero; the first state is the doubted one."""
    H = np.zeros(SIZE)
    for state, coefficient in terms:
        H[state] = coefficient
    return Row(H, terms[0][0])


class Drive(NamedTuple):
    """What dead reckoning goes by until something newer arrives."""

    yaw_rate_radps: float = 0.0
    """The gyro's bias still in it, if it is the gyro's."""
    gyro: bool = False
    cos_pitch: float = 1.0
    """Speed times this is horizontal."""
    yaw_q: float = 0.0
    """Variance of the heading's growth, [rad^2/s]."""
    brisk_mps2: float = 0.0
    """How much harder the vehicle is accelerated than at other times, as the IMU feels it."""
    braking_mps2: float | None = None
    """What the IMU feels along the way under hard brakes, when sliding wheels tell little."""


@dataclass
class Filter:
    """State, covariance, and since when each source has been refused."""

    parameters: EgoParameters
    state: Floats = field(default_factory=lambda: np.zeros(SIZE))
    covariance: Floats = field(default_factory=lambda: np.zeros((SIZE, SIZE)))
    refused_since_ns: dict[str, int] = field(default_factory=dict[str, int])
    _behind_s: float = 0.0
    """How far the covariance lags behind the state ..."""
    _east_s: float = 0.0
    _north_s: float = 0.0
    """... and the way of that time for each m/s."""
    _transition: Floats = field(default_factory=lambda: np.eye(SIZE))

    def yaw_rate(self, drive: Drive) -> float:
        """The heading's rate, without the gyro's bias, [rad/s]."""
        return drive.yaw_rate_radps - (float(self.state[GYRO_BIAS]) if drive.gyro else 0.0)

    def predict(self, dt_s: float, drive: Drive) -> None:
        """Drive on for `dt_s`, [s]."""
        x, y, heading, v = self.state[:4].tolist()
        if drive.braking_mps2 is not None:
            v = self._brake(v, drive.braking_mps2 * dt_s)
        turn = self.yaw_rate(drive) * dt_s
        ahead = dt_s * drive.cos_pitch
        middle = heading + 0.5 * turn
        c, s = ahead * math.cos(middle), ahead * math.sin(middle)
        self.state[:3] = x + v * c, y + v * s, heading + turn
        self._east_s += c
        self._north_s += s
        self._behind_s += dt_s
        if self._behind_s >= COVARIANCE_S:
            self._spread(v, drive)

    def _brake(self, v: float, gain_mps: float) -> float:
        """Lose speed, down to none; the mean speed meanwhile."""
        left = v + gain_mps
        if left * v <= 0.0:
            left = 0.0
        self.state[SPEED] = left
        return 0.5 * (v + left)

    def _spread(self, v: float, drive: Drive) -> None:
        """Let the covariance catch up with the state."""
        dt = self._behind_s
        F = self._transition
        F[X, HEADING], F[Y, HEADING] = -v * self._north_s, v * self._east_s
        F[X, SPEED], F[Y, SPEED] = self._east_s, self._north_s
        F[HEADING, GYRO_BIAS] = -dt if drive.gyro else 0.0
        F[GPS_X, GPS_X] = F[GPS_Y, GPS_Y] = fade = math.exp(-dt / self.parameters.gps.offset_s)
        self.state[GPS_X:] *= fade
        self.covariance = F.dot(self.covariance).dot(F.T)
        self.covariance.ravel()[:: SIZE + 1] += self._noise(dt, abs(v), drive, fade)
        self._behind_s = self._east_s = self._north_s = 0.0

    def _noise(self, dt_s: float, speed_mps: float, drive: Drive, fade: float) -> Floats:
        """The diagonal of Q. Under full brakes the speed falls faster than otherwise, and sliding
        wheels fall ahead of it: with the usual noise both wheels and GPS would be refused."""
        p = self.parameters
        slip = p.motion.slip_m**2 * (speed_mps + MIN_WAY_RATE_MPS) * dt_s
        acceleration = p.motion.acceleration_mps2 + drive.brisk_mps2
        offset = 1.0 - fade * fade
        return np.array([
            slip, slip, drive.yaw_q * dt_s, acceleration * acceleration * dt_s,
            p.motion.gyro_bias_radps**2 * dt_s, p.compass.bias_drift_rad**2 * dt_s,
            p.wheels.scale_drift**2 * dt_s, offset, offset,
        ])  # fmt: skip

    def fits(self, row: Row, innovation: float, variance: float) -> bool:
        """Whether the innovation, measured - expected, lies within the gate."""
        return self._within(innovation, self._project(row)[1] + variance)

    def correct(
        self, source: str, time_ns: int, row: Row, innovation: float, variance: float
    ) -> None:
        """`update` behind the gate. What was refused for too long makes doubt of row's first."""
        gain, spread = self._project(row)
        fits = self._within(innovation, spread + variance)
        if self.admit(source, time_ns, fits):
            if not fits:
                self.doubt(row.doubted, innovation)
                gain, spread = self._project(row)
            self._move(gain, innovation, spread + variance)

    def update(self, row: Row, innovation: float, variance: float) -> Floats:
        """Take one scalar measurement; `variance` is that of its noise.

        Returns:
            By how much the state moved, shape (9,).
        """
        gain, spread = self._project(row)
        return self._move(gain, innovation, spread + variance)

    def _project(self, row: Row) -> tuple[Floats, float]:
        """P H^T, shape (9,), and H P H^T."""
        gain = self.covariance.dot(row.H)
        return gain, row.along(gain)

    def _within(self, innovation: float, variance: float) -> bool:
        return innovation * innovation <= self.parameters.gate.sd**2 * variance

    def _move(self, gain: Floats, innovation: float, variance: float) -> Floats:
        moved = gain * (innovation / variance)
        self.state += moved
        unit = gain * (1.0 / math.sqrt(variance))
        self.covariance -= unit[:, None].dot(unit[None])  # quicker than their product
        return moved

    def admit(self, source: str, time_ns: int, fits: bool) -> bool:
        """Whether a source may speak: it fits, or has been refused for longer than patience."""
        if fits:
            self.refused_since_ns.pop(source, None)
            return True
        since = self.refused_since_ns.setdefault(source, time_ns)
        if time_ns - since < self.parameters.gate.patience_s * 1e9:
            return False
        del self.refused_since_ns[source]
        return True

    def doubt(self, index: int, innovation: float) -> None:
        """A refused source was right after all: the state may be wrong by as much."""
        wrong = min(abs(innovation), MOST_DOUBT)
        self.covariance[index, index] += wrong * wrong

    def redraw_gps_offset(self) -> None:
        """The receiver's offset is another one now: forget it and what it went along with."""
        self.state[GPS_X:] = 0.0
        self.covariance[GPS_X:, :] = 0.0
        self.covariance[:, GPS_X:] = 0.0
        self.covariance[GPS_X, GPS_X] = self.covariance[GPS_Y, GPS_Y] = 1.0
