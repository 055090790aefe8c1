"""Places in the vehicle's frame that the obstacle map asks about."""

from math import cos, sin

import numpy as np

from nav.fusion.scan_geometry import Pose
from nav.messages import Floats
from nav.parameters.vehicle import Outline, VehicleParameters


def turned(place: Floats, pose: Pose) -> Floats:
    """Places of the vehicle frame, shape (2 or more, n), east and north in N, shape (2, n)."""
    c, s = cos(pose.heading_rad), sin(pose.heading_rad)
    x, y = place[0], place[1]
    return np.stack([pose.x_m + c * x - s * y, pose.y_m + s * x + c * y])


def footprint(outline: Outline, cell_m: float) -> Floats:
    """Places in the vehicle's outline, closer together than cells, shape (2, n)."""
    length, width = outline.front_m - outline.rear_m, 2 * outline.half_width_m
    x = np.linspace(outline.rear_m, outline.front_m, int(length / cell_m * 1.5) + 1)
    y = np.linspace(-outline.half_width_m, outline.half_width_m, int(width / cell_m * 1.5) + 1)
    return np.stack(np.meshgrid(x, y)).reshape(2, -1)


def wheels(vehicle: VehicleParameters) -> Floats:
    """Wheels of the front axle and at the reference point, shape (4, 2)."""
    half = vehicle.track_m / 2
    return np.array([(x, y) for x in (0.0, vehicle.wheelbase_m) for y in (-half, half)])


def sonar_arcs(vehicle: VehicleParameters) -> tuple[Floats, Floats]:
    """Origin (n, 1, 3) of each sonar and directions (n, 3, 3) across its cone."""
    mounts = vehicle.sonar_mounts.values()
    origin = np.array([mount.position_m for mount in mounts]).reshape(-1, 3)
    across = np.array([-1.0, 0.0, 1.0]) * vehicle.sonar.half_cone_rad
    yaw = np.array([mount.yaw_rad for mount in mounts])[:, None] + across
    return origin[:, None, :], np.stack([np.cos(yaw), np.sin(yaw), np.zeros_like(yaw)], axis=-1)
