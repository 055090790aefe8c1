"""One check for each kind of device but the scanners: why its message is implausible, or nothing;
None where there is nothing to hold it against."""

from collections import deque
from dataclasses import dataclass, field
from math import hypot

import numpy as np

from nav.fusion.plausibility.witnesses import Ego, Witnesses
from nav.messages import (
    CompassHeading,
    Floats,
    GpsFix,
    GpsQuality,
    ImuSample,
    RadarTracks,
    SonarScan,
    VehicleState,
)
from nav.parameters.plausibility import PlausibilityParameters

STEADY_S = 0.5
FROZEN = "frozen"
LATE_MESSAGES = 20
"""Of the wheels, 0.4 s: a fix is not older."""
LEAST_SONARS = 2
"""One alone may pass from thing to thing."""
TURNING_MPS = 0.1
"""Wheels that stand may say so again and again."""


def _short() -> deque[tuple[int, float]]:
    """As long as a fix is fresh."""
    return deque(maxlen=LATE_MESSAGES)


@dataclass
class Repeats:
    """Whether a device says the same again."""

    said: bytes = b""

    def again(self, *numbers: float | Floats) -> bool:
        """Take what it says now."""
        before, self.said = self.said, b"".join(np.asarray(n).tobytes() for n in numbers)
        return before == self.said


@dataclass
class Fixes:
    """GPS against dead reckoning: what has never lost its satellites does not jump."""

    parameters: PlausibilityParameters
    repeats: Repeats
    outage_ns: int | None = None
    """When it was without a solution last."""

    def wrong(self, fix: GpsFix, ego: Ego, others: Witnesses) -> str | None:
        """See the module."""
        del others
        p = self.parameters
        if fix.quality is GpsQuality.NONE or self.outage_ns is None:
            self.outage_ns = fix.time_ns
        if fix.quality is GpsQuality.NONE:
            return None
        if self.repeats.again(fix.latitude_deg, fix.longitude_deg):
            return FROZEN
        if not ego.ready or fix.time_ns - self.outage_ns < p.gps_outage_s * 1e9:
            return ""
        gap_m, sd_m = ego.antenna_gap_m(fix)
        far = gap_m > p.gps_m + p.gps_sd * (sd_m + fix.sd_m)
        return f"{gap_m:.1f} m from dead reckoning" if far else ""


@dataclass
class Gyro:
    """Yaw rates against themselves, and against what wheels and steering do."""

    parameters: PlausibilityParameters
    repeats: Repeats
    yaw_radps: float | None = None
    steering_rad: float = 0.0
    """Smoothed."""

    def wrong(self, sample: ImuSample, ego: Ego, others: Witnesses) -> str | None:
        """See the module."""
        p, (*_, yaw) = self.parameters, sample.angular_rate_radps.tolist()
        before, self.yaw_radps = self.yaw_radps, yaw
        if self.repeats.again(sample.angular_rate_radps):
            return FROZEN
        if before is not None and abs(yaw - before) > p.gyro_step_radps:
            return "noisy"
        state = others.state_at(sample.time_ns)
        return self._beside(yaw, state, ego) if state and ego.ready else ""

    def _beside(self, yaw: float, state: VehicleState, ego: Ego) -> str:
        p, steering = self.parameters, state.steering_rad
        turning = abs(steering - self.steering_rad) > p.steady_rad
        self.steering_rad += (steering - self.steering_rad) * 0.01 / STEADY_S
        if turning or state.shifting:
            return ""
        if abs(ego.speed_mps) < p.moving_mps:
            still = float(state.wheel_speed_mps.max()) < 0.1
            return f"{yaw:.2f} rad/s at a stand" if still and abs(yaw) > p.gyro_still_radps else ""
        expected = ego.yaw_rate_of(steering)
        far = abs(yaw - expected) > p.gyro_radps + p.gyro_share * abs(expected)
        return f"{yaw - expected:.2f} rad/s beside the steering" if far else ""


@dataclass
class Wheels:
    """Wheel speeds against the speed of a fix, as they were at its time."""

    parameters: PlausibilityParameters
    repeats: Repeats
    wheel_mps: Floats | None = None
    _middle_mps: deque[tuple[int, float]] = field(default_factory=_short)
    """Times and medians of late."""

    def wrong(self, state: VehicleState, ego: Ego, others: Witnesses) -> str | None:
        """See the module."""
        p, moving = self.parameters, abs(ego.speed_mps) > self.parameters.moving_mps
        before, self.wheel_mps = self.wheel_mps, state.wheel_speed_mps
        self._middle_mps.append((state.time_ns, _middle(state.wheel_speed_mps)))
        if self.repeats.again(state.wheel_speed_mps):
            return FROZEN if float(state.wheel_speed_mps.max()) > TURNING_MPS else None
        if before is not None and _middle(np.abs(self.wheel_mps - before)) > p.wheel_step_mps:
            return "noisy"
        fix = others.fix_at(state.time_ns)
        if fix is None or not ego.ready:
            return None if others.fix else ""
        east, north, _ = fix.velocity_mps.tolist()
        apart = self._at(fix.time_ns) - hypot(east, north)
        if abs(apart) <= p.wheels_mps:
            return ""
        spinning = not moving and state.throttle > 0.1  # in a hole, say: that is no fault
        sliding = apart < 0.0 and state.brake > p.sliding_brake  # neither is that
        return None if spinning or sliding else f"{apart:.1f} m/s beside GPS"

    def _at(self, time_ns: int) -> float:
        """The median at the time of a fix; the oldest that is known."""
        return next((v for t, v in self._middle_mps if t >= time_ns), self._middle_mps[-1][1])


@dataclass
class Compass:
    """The compass against the estimated heading."""

    parameters: PlausibilityParameters
    repeats: Repeats

    def wrong(self, compass: CompassHeading, ego: Ego, others: Witnesses) -> str | None:
        """See the module."""
        del others
        if not ego.ready:
            return ""
        if self.repeats.again(compass.heading_rad):
            return FROZEN if abs(ego.speed_mps) > self.parameters.moving_mps else None
        gap = abs(ego.compass_gap_rad(compass.heading_rad))
        return f"{gap:.2f} rad off" if gap > self.parameters.compass_rad else ""


@dataclass
class Ranges:
    """Sonars and radars: what sees something, and moves, does not say the same again."""

    parameters: PlausibilityParameters
    repeats: Repeats
    range_m: Floats | None = None
    """Of the sonars."""

    def wrong(self, echoes: SonarScan | RadarTracks, ego: Ego, others: Witnesses) -> str | None:
        """See the module."""
        del others
        range_m = echoes.range_m
        again = self.repeats.again(range_m)
        if isinstance(echoes, SonarScan) and self._jump(echoes, ego):
            return "noisy"
        sees = range_m.size > 0 and float(range_m.min()) < float(range_m.max())
        if not sees:
            return None
        if again:
            return FROZEN if abs(ego.speed_mps) > self.parameters.moving_mps else None
        return ""

    def _jump(self, echoes: SonarScan, ego: Ego) -> bool:
        """Whether half of those that hear something, two at least, have jumped since last time."""
        p, before, range_m = self.parameters, self.range_m, echoes.range_m
        self.range_m = range_m
        if before is None:
            return False
        near = (range_m < range_m.max()) & (before < before.max())  # the farthest hears nothing
        step_m = p.sonar_step_m + p.sonar_round_s * abs(ego.speed_mps)
        jumped = near & (np.abs(range_m - before) > step_m)
        count = int(np.count_nonzero(jumped))
        return count >= LEAST_SONARS and 2 * count >= int(np.count_nonzero(near))


def _middle(wheels: Floats) -> float:
    """Median of six."""
    return float(np.sort(wheels)[2:4].mean())
