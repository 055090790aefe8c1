"""Engine, CVT and brakes: from pedal positions to torques at the wheels.

Plain floats and small functions: all of it runs 300 times a simulated second.
Numbers with unit, source and grade: models/README.md.
"""

from dataclasses import dataclass
from math import exp

from twin.vehicle import WHEEL_RADIUS_M


@dataclass(frozen=True)
class Range:
    """What the CVT gives in one position of the gearbox."""

    direction: float
    """+1 forwards, -1 backwards, 0 disconnected."""
    force_n: float
    """Largest tractive force, all wheels together."""
    top_mps: float
    """Speed at which the engine's limiter has taken all the power away."""
    braking_n_per_mps: float
    """Engine braking with the throttle closed, a speed."""
    braking_limit_n: float


@dataclass(frozen=True)
class DrivetrainParameters:
    """The driveline of a Ranger 6x6 in six-wheel drive."""

    power_w: float = 17_000.0
    """Published 30 hp at the crank, 76 % of it through CVT and three axles (estimated)."""
    engine_lag_s: float = 0.3
    reverse: Range = Range(-1.0, 4500.0, 6.0, 250.0, 600.0)
    neutral: Range = Range(0.0, 0.0, 1.0, 0.0, 0.0)
    low: Range = Range(1.0, 5500.0, 10.0, 200.0, 700.0)
    high: Range = Range(1.0, 3000.0, 18.6, 60.0, 350.0)
    limiter_mps: float = 1.5
    """Width below the top speed in which the limiter works."""
    clutch_mps: float = 1.0
    """Below this speed the centrifugal clutch releases: no engine braking, and no idle creep."""
    slip_n_m_s: float = 20.0
    """Coupling of the axles: torque for a wheel's difference from the mean speed, [N m s/rad]."""
    rolling_n_m: float = 16.0
    """Rolling resistance of a wheel: 3 % of its load (10 psi tires on dirt)."""
    brake_n_m: tuple[float, ...] = (470.0, 470.0, 380.0, 380.0, 0.0, 0.0)
    """Largest brake torque of each wheel; four wheels are braked."""
    drag_n_s2_m2: float = 1.2
    """Aerodynamic drag: half density x 2.0 m^2 of drag area."""

    def engaged(self, gear: int) -> Range:
        """What the CVT gives in a position of the linkage."""
        return (self.reverse, self.neutral, self.low, self.high)[gear]


class Engine:
    """The engine's answer to the throttle: a first-order lag."""

    def __init__(self, parameters: DrivetrainParameters, dt_s: float) -> None:
        self.parameters = parameters
        self.output = 0.0
        self._gain = 1.0 - exp(-dt_s / parameters.engine_lag_s)

    def force(self, throttle: float, gear: int, speed_mps: float) -> float:
        """Advance by one step; tractive force along the vehicle's x axis, [N]."""
        self.output += self._gain * (throttle - self.output)
        return tractive_force(self.parameters, self.output, gear, speed_mps)


def tractive_force(
    parameters: DrivetrainParameters, output: float, gear: int, speed_mps: float
) -> float:
    """Force of all wheels together [N] for an engine output 0 to 1 at a signed speed."""
    engaged = parameters.engaged(gear)
    if engaged.direction == 0.0:
        return 0.0
    speed = engaged.direction * speed_mps
    drive = output * _available(parameters, engaged, speed)
    return engaged.direction * (
        drive - (1.0 - output) * _engine_braking(parameters, engaged, speed)
    )


def _available(parameters: DrivetrainParameters, engaged: Range, speed: float) -> float:
    force = min(engaged.force_n, parameters.power_w / max(speed, 0.1))
    return force * min(1.0, max(0.0, (engaged.top_mps - speed) / parameters.limiter_mps))


def _engine_braking(parameters: DrivetrainParameters, engaged: Range, speed: float) -> float:
    slipping = max(0.0, speed - parameters.clutch_mps)
    return min(engaged.braking_limit_n, engaged.braking_n_per_mps * slipping)


def wheel_torques(
    parameters: DrivetrainParameters, force_n: float, spin_radps: list[float]
) -> list[float]:
    """Drive torque of each wheel [N m]: equal shares, less what a faster wheel gives to others."""
    share = force_n * WHEEL_RADIUS_M / len(spin_radps)
    mean = (
        spin_radps[0] + spin_radps[1] + spin_radps[2]
        + spin_radps[3] + spin_radps[4] + spin_radps[5]
    ) / 6.0  # fmt: skip
    return [share + parameters.slip_n_m_s * (mean - w) for w in spin_radps]


def friction_torques(parameters: DrivetrainParameters, brake: float) -> list[float]:
    """Dry friction at each wheel [N m]: rolling resistance and brake."""
    return [parameters.rolling_n_m + brake * b for b in parameters.brake_n_m]
