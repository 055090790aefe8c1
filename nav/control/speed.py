"""Speed: PI on the throttle with a feed-forward, proportional on the brake."""

from dataclasses import dataclass

from nav.parameters.control import SpeedControl


@dataclass
class SpeedController:
    """Holds a set point; remembers its ramp and its integral."""

    parameters: SpeedControl
    integral: float = 0.0
    ramp_mps: float = 0.0

    def step(self, set_point_mps: float, speed_mps: float, dt_s: float) -> tuple[float, float]:
        """Throttle and brake, 0 to 1, never both."""
        p = self.parameters
        if set_point_mps < p.stop_mps:
            return self._stop(speed_mps)
        ceiling = min(
            max(self.ramp_mps, speed_mps, 0.0) + p.acceleration_mps2 * dt_s, speed_mps + 1.5
        )
        self.ramp_mps = min(set_point_mps, max(ceiling, 0.5))
        error = self.ramp_mps - speed_mps
        if error < -p.brake_band_mps:
            self.integral = min(self.integral, 0.0)
            return 0.0, -p.brake_proportional * (error + p.brake_band_mps)
        return self._throttle(error, self.ramp_mps < set_point_mps, dt_s), 0.0

    def _throttle(self, error: float, rises: bool, dt_s: float) -> float:
        p = self.parameters
        base = p.feedforward + p.feedforward_per_mps * self.ramp_mps + p.proportional * error
        base += p.feedforward_per_mps2 * p.acceleration_mps2 if rises else 0.0
        throttle = base + self.integral
        if 0.0 < throttle < 1.0 and not rises:  # rising, it lags for a while only
            wound = self.integral + p.integral * error * dt_s
            self.integral = min(max(wound, -p.integral_limit), p.integral_limit)
        return min(max(throttle, 0.0), 1.0)

    def _stop(self, speed_mps: float) -> tuple[float, float]:
        """Brake with all force but for the last metre a second, and hold."""
        p = self.parameters
        self.integral, self.ramp_mps = 0.0, 0.0
        return 0.0, min(max(p.hold_brake, abs(speed_mps) - p.brake_band_mps), 1.0)
