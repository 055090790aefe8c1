"""Road-wheel angle and curvature: the measured turning circle of a Ranger 6x6 (facts.md)."""

from math import sqrt

from nav.parameters.vehicle import Steering


def steering_angle(curvature_per_m: float, steering: Steering) -> float:
    """Road-wheel angle for a curvature, limit * (linear * k + quadratic * k^2), [rad]."""
    k = min(abs(curvature_per_m), 1.0 / steering.minimum_radius_m)
    angle = steering.limit_rad * (steering.linear_m * k + steering.quadratic_m2 * k * k)
    return angle if curvature_per_m >= 0.0 else -angle


def curvature(steering_rad: float, steering: Steering) -> float:
    """Curvature that a road-wheel angle leads to: the inverse of `steering_angle`, [1/m]."""
    a, b = steering.quadratic_m2, steering.linear_m
    fraction = min(abs(steering_rad) / steering.limit_rad, 1.0)
    root = sqrt(max(b * b + 4.0 * a * fraction, 0.0))
    k = min(2.0 * fraction / (b + root), 1.0 / steering.minimum_radius_m)
    return k if steering_rad >= 0.0 else -k


def curvature_rate(steering: Steering) -> float:
    """How fast the curvature can change near straight ahead, [1/(m s)]."""
    return steering.rate_radps / (steering.limit_rad * steering.linear_m)
