"""Messages of `nav.messages` as well-known Foxglove schemas: one pure function each.

Frames: `route` (N, the fixed frame), `vehicle`, and one for each scanner, named like it.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from foxglove.messages import (
    ArrowPrimitive,
    Color,
    CubePrimitive,
    FrameTransform,
    FrameTransforms,
    LaserScan,
    LocationFix,
    LocationFixPositionCovarianceType,
    Log,
    LogLevel,
    PackedElementField,
    PackedElementFieldNumericType,
    PointCloud,
    Pose,
    PosesInFrame,
    Quaternion,
    SceneEntity,
    SceneUpdate,
    TextPrimitive,
    Timestamp,
    Vector3,
)

from nav.messages import (
    LIDAR_NO_RETURN_M,
    Decision,
    EgoEstimate,
    FollowPath,
    GpsFix,
    LidarScan,
    ObstacleCells,
)

ROUTE, VEHICLE = "route", "vehicle"

BODY = Color(r=0.85, g=0.65, b=0.15, a=0.6)
GOAL = Color(r=0.3, g=0.6, b=1.0, a=0.8)
DECIDED = Color(r=0.2, g=0.9, b=0.3, a=0.9)
WHITE = Color(r=1.0, g=1.0, b=1.0, a=1.0)
IDENTITY = Pose(position=Vector3(), orientation=Quaternion(w=1.0))
GOAL_ARROW_M = 5.0
LABEL_HEIGHT_M = 3.0

_FLOAT32 = PackedElementFieldNumericType.Float32


def _fields(*names: str) -> list[PackedElementField]:
    return [PackedElementField(name=n, offset=4 * i, type=_FLOAT32) for i, n in enumerate(names)]


_XY_CONFIDENCE = _fields("x", "y", "confidence")


def scan(stamp: Timestamp, message: LidarScan) -> LaserScan:
    """A scan in the scanner's frame, to 1/64 m: short fractions halve its size on the disk."""
    range_m = np.rint(message.range_m * 64) / 64
    range_m[message.range_m >= LIDAR_NO_RETURN_M] = math.inf
    return LaserScan(
        timestamp=stamp,
        frame_id=message.sensor,
        pose=IDENTITY,
        start_angle=-math.pi / 2,
        end_angle=math.pi / 2,
        ranges=range_m.tolist(),
    )


def obstacles(stamp: Timestamp, message: ObstacleCells) -> PointCloud:
    """Occupied cells as points in the route frame, with their confidence."""
    points = np.column_stack((message.position_m, message.confidence)).astype(np.float32)
    return PointCloud(
        timestamp=stamp,
        frame_id=ROUTE,
        pose=IDENTITY,
        point_stride=12,
        fields=_XY_CONFIDENCE,
        data=points.tobytes(),
    )


def ego_frame(stamp: Timestamp, ego: EgoEstimate) -> FrameTransforms:
    """Where the vehicle believes to be in the route frame."""
    x_m, y_m = ego.position_m.tolist()
    rotation = quaternion(ego.heading_rad, ego.pitch_rad, ego.roll_rad)
    return FrameTransforms(transforms=[_frame(stamp, ROUTE, VEHICLE, (x_m, y_m, 0.0), rotation)])


def mounting_frames(stamp: Timestamp, mountings: Mapping[str, Any]) -> FrameTransforms:
    """Where the scanners sit in the vehicle frame."""
    frames = []
    for name, m in mountings.items():
        rotation = quaternion(m.yaw_rad, m.pitch_rad, m.roll_rad)
        frames.append(_frame(stamp, VEHICLE, name, m.position_m, rotation))
    return FrameTransforms(transforms=frames)


def vehicle(
    stamp: Timestamp, front_m: float, rear_m: float, half_width_m: float, height_m: float
) -> SceneUpdate:
    """The vehicle as a box that moves with its frame."""
    center = Vector3(x=(front_m + rear_m) / 2, z=height_m / 2)
    box = CubePrimitive(
        pose=Pose(position=center, orientation=Quaternion(w=1.0)),
        size=Vector3(x=front_m - rear_m, y=2 * half_width_m, z=height_m),
        color=BODY,
    )
    entity = SceneEntity(
        timestamp=stamp, frame_id=VEHICLE, id="vehicle", frame_locked=True, cubes=[box]
    )
    return SceneUpdate(entities=[entity])


def path(stamp: Timestamp, message: FollowPath) -> PosesInFrame:
    """The pathpoints, each looking at the next."""
    points = message.pathpoint_m
    step = np.diff(points, axis=0)
    yaw = np.arctan2(step[:, 1], step[:, 0]).tolist() or [0.0]
    poses = [
        Pose(position=Vector3(x=x, y=y), orientation=quaternion(a))
        for (x, y), a in zip(points.tolist(), [*yaw, yaw[-1]], strict=False)
    ]
    return PosesInFrame(timestamp=stamp, frame_id=ROUTE, poses=poses)


def decision(stamp: Timestamp, message: Decision, ego: EgoEstimate) -> SceneUpdate:
    """Goal and decided heading as arrows at the vehicle, and its state as a label above."""
    x_m, y_m = ego.position_m.tolist()
    arrows = [
        _arrow((x_m, y_m), message.goal_rad, GOAL_ARROW_M, GOAL),
        _arrow((x_m, y_m), message.decision_rad, message.D_m, DECIDED),
    ]
    label = TextPrimitive(
        pose=Pose(position=Vector3(x=x_m, y=y_m, z=LABEL_HEIGHT_M), orientation=Quaternion(w=1.0)),
        billboard=True,
        font_size=0.6,
        color=WHITE,
        text=f"{message.state} {message.speed_mps:.1f} m/s",
    )
    entity = SceneEntity(
        timestamp=stamp, frame_id=ROUTE, id="decision", arrows=arrows, texts=[label]
    )
    return SceneUpdate(entities=[entity])


def location(stamp: Timestamp, fix: GpsFix) -> LocationFix:
    """The GPS solution on a map, with the receiver's own idea of its error."""
    variance = fix.sd_m**2
    return LocationFix(
        timestamp=stamp,
        frame_id="gps",
        latitude=fix.latitude_deg,
        longitude=fix.longitude_deg,
        altitude=fix.altitude_m,
        position_covariance=[variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, variance],
        position_covariance_type=LocationFixPositionCovarianceType.Approximated,
    )


def state_change(stamp: Timestamp, message: Decision) -> Log:
    """One line for a state that was entered, with the reason."""
    return Log(
        timestamp=stamp,
        level=LogLevel.Info,
        message=f"{message.state}: {message.reason}",
        name="navigator",
    )


def quaternion(yaw_rad: float, pitch_rad: float = 0.0, roll_rad: float = 0.0) -> Quaternion:
    """Rotation about z, then the new y, then the new x; all right-handed."""
    cy, sy = math.cos(yaw_rad / 2), math.sin(yaw_rad / 2)
    cp, sp = math.cos(pitch_rad / 2), math.sin(pitch_rad / 2)
    cr, sr = math.cos(roll_rad / 2), math.sin(roll_rad / 2)
    return Quaternion(
        w=cy * cp * cr + sy * sp * sr,
        x=cy * cp * sr - sy * sp * cr,
        y=cy * sp * cr + sy * cp * sr,
        z=sy * cp * cr - cy * sp * sr,
    )


def _frame(
    stamp: Timestamp,
    parent: str,
    child: str,
    position_m: tuple[float, float, float],
    rotation: Quaternion,
) -> FrameTransform:
    x, y, z = position_m
    return FrameTransform(
        timestamp=stamp,
        parent_frame_id=parent,
        child_frame_id=child,
        translation=Vector3(x=x, y=y, z=z),
        rotation=rotation,
    )


def _arrow(
    position_m: tuple[float, float], heading_rad: float, length_m: float, color: Color
) -> ArrowPrimitive:
    x, y = position_m
    return ArrowPrimitive(
        pose=Pose(position=Vector3(x=x, y=y, z=0.5), orientation=quaternion(heading_rad)),
        shaft_length=length_m,
        shaft_diameter=0.15,
        head_length=0.6,
        head_diameter=0.4,
        color=color,
    )
