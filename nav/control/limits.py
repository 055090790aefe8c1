"""The one place where commands to actuators are limited, last before they leave."""

from nav.messages import ActuatorTargets, Gear


def limited(
    time_ns: int, steering_rad: float, throttle: float, brake: float, gear: Gear, limit_rad: float
) -> ActuatorTargets:
    """Targets within limits; the brake wins over the throttle."""
    brake = min(max(brake, 0.0), 1.0)
    throttle = 0.0 if brake > 0.0 else min(max(throttle, 0.0), 1.0)
    steering = min(max(steering_rad, -limit_rad), limit_rad)
    return ActuatorTargets(time_ns, steering, throttle, brake, gear)
