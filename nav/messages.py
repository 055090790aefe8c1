"""The contract: what crosses the boundary between the navigator and the world.

Frames: the vehicle frame has x forward, y left, z up and its origin at the reference point, the
ground midpoint of the two rear axles. The route frame N is east-north-up, anchored at the
route's first waypoint. Angles count counter-clockwise; headings count from east.

Every message carries the time of its measurement, `time_ns`. Arrays are copied into contiguous,
read-only float64 at construction, so that nobody can change what was said.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from enum import IntEnum
from functools import cache
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

LIDAR_COUNT_M = 0.01
"""One count of a SICK LMS 221 range, in metres."""
LIDAR_NO_RETURN_COUNT = 8192
"""The count that means "no return": 81.92 m, one above the largest range."""
LIDAR_NO_RETURN_M = LIDAR_NO_RETURN_COUNT * LIDAR_COUNT_M
"""What such a beam reads in metres: no other reads as much."""


class Gear(IntEnum):
    """Positions of the gear linkage in their mechanical order."""

    REVERSE = 0
    NEUTRAL = 1
    LOW = 2
    HIGH = 3


class GpsQuality(IntEnum):
    """What the receiver says of its solution."""

    NONE = 0
    SINGLE = 1
    DIFFERENTIAL = 2
    CONVERGED = 5


def lidar_range_m(counts: NDArray[np.uint16]) -> Floats:
    """The one decoder of LIDAR counts. `c * 0.01`, never `c / 100`: the bits differ."""
    return counts.astype(np.float64) * LIDAR_COUNT_M


def frozen(value: Any) -> Floats:
    """A copy that nobody can change."""
    array = np.array(value, dtype=np.float64, order="C")
    array.setflags(write=False)
    return array


class _Message:
    """Freezes the array fields of a message at construction."""

    def __post_init__(self) -> None:
        for name in _array_fields(type(self)):
            object.__setattr__(self, name, frozen(getattr(self, name)))


@cache
def _array_fields(cls: type[Any]) -> tuple[str, ...]:
    return tuple(f.name for f in fields(cls) if f.type is Floats)


# ---------------------------------------------------------------- sensors, into the navigator


@dataclass(frozen=True, eq=False)
class LidarScan(_Message):
    """One scan of a SICK LMS 221 at 37.5 Hz: 361 beams from -90 to +90 degrees in its own plane."""

    time_ns: int
    sensor: str
    range_m: Floats = field(metadata={"count": LIDAR_COUNT_M})
    """Shape (361,), [m], first beam to the right; 81.92 means no return."""


@dataclass(frozen=True, eq=False)
class SonarScan(_Message):
    """One round of all sonars at 20 Hz, in the order of the vehicle's parameters."""

    time_ns: int
    range_m: Floats
    """Shape (8,), [m]; the device's maximum range means no echo, 0 means that it is silent."""


@dataclass(frozen=True, eq=False)
class GpsFix(_Message):
    """A GPS solution at 20 Hz. With quality NONE, position and velocity are the last known."""

    time_ns: int
    quality: GpsQuality
    satellites: int
    latitude_deg: float
    longitude_deg: float
    altitude_m: float
    sd_m: float
    """What the receiver believes of its horizontal error, one sigma an axis, [m]."""
    velocity_mps: Floats
    """Shape (3,), east, north, up, [m/s]."""


@dataclass(frozen=True, eq=False)
class ImuSample(_Message):
    """Vertical gyro and accelerometers at 100 Hz, in the vehicle frame."""

    time_ns: int
    angular_rate_radps: Floats
    """Shape (3,), [rad/s]."""
    acceleration_mps2: Floats
    """Shape (3,), specific force, +9.81 upwards at rest, [m/s^2]."""
    roll_rad: float
    """Positive with the left side up."""
    pitch_rad: float
    """Positive with the nose down (right-handed about y left)."""


@dataclass(frozen=True, eq=False)
class CompassHeading(_Message):
    """Digital compass at 10 Hz, declination already removed."""

    time_ns: int
    heading_rad: float
    """Counter-clockwise from east, in (-pi, pi]."""


@dataclass(frozen=True, eq=False)
class VehicleState(_Message):
    """What the drive-by-wire unit reports back at 50 Hz."""

    time_ns: int
    wheel_speed_mps: Floats
    """Shape (6,), front left, front right, middle l, r, rear l, r; unsigned as a tooth counter."""
    steering_rad: float
    """Mean road-wheel angle of the front axle, left positive."""
    throttle: float
    """Position of the throttle, 0 to 1."""
    brake: float
    """Position of the brake, 0 to 1."""
    gear: Gear
    """Where the linkage is."""
    shifting: bool
    """True while the linkage is on its way."""


@dataclass(frozen=True, eq=False)
class RadarTracks(_Message):
    """Tracks of an Eaton VORAD EVT-300 at 15 Hz: at most seven, in its own plane."""

    time_ns: int
    range_m: Floats
    """Shape (n,), [m]."""
    azimuth_rad: Floats
    """Shape (n,), left positive."""
    range_rate_mps: Floats
    """Shape (n,), negative for what comes nearer."""


@dataclass(frozen=True, eq=False)
class RoadEstimate(_Message):
    """What the image-processing module says of the road ahead, at 10 Hz."""

    time_ns: int
    offset_m: float
    """How far left of the road's middle the reference point is."""
    heading_rad: float
    """Direction of the road relative to the vehicle's x axis, left positive."""
    width_m: float
    confidence: float
    """0 to 1."""


# ---------------------------------------------------------------- commands, out of the navigator


@dataclass(frozen=True, eq=False)
class ActuatorTargets(_Message):
    """Every 20 ms: what the actuators shall do. The last thing before it leaves is its limits."""

    time_ns: int
    steering_rad: float
    """Road-wheel angle, left positive."""
    throttle: float
    """0 to 1."""
    brake: float
    """0 to 1, never together with throttle."""
    gear: Gear


@dataclass(frozen=True, eq=False)
class FollowPath(_Message):
    """A command of the high-level controller: ten pathpoints and a speed set point."""

    time_ns: int
    pathpoint_m: Floats
    """Shape (10, 2), route frame N, [m]."""
    speed_mps: float
    least_throttle: float = 0.0
    """While the vehicle hardly moves the throttle is at least this: the watchdog's way out."""


@dataclass(frozen=True, eq=False)
class UnitOperation(_Message):
    """A command of the high-level controller: one robotic unit operation, an arc in one gear."""

    time_ns: int
    gear: Gear
    """Shifted to at a stand, however long it takes; then steered, then driven."""
    steering_rad: float
    """Road-wheel angle, left positive."""
    remaining_m: float
    """Way that is still to go, [m]; at 0 the vehicle stands."""
    speed_mps: float


STOP, RESET = "stop_and_wait", "reset_sensor"


@dataclass(frozen=True, eq=False)
class DirectCommand(_Message):
    """A direct command of the high-level controller; the vehicle stands while it holds."""

    time_ns: int
    name: str
    """STOP or RESET."""
    sensor: str = ""
    """Which one is to be reset."""


@dataclass(frozen=True, eq=False)
class EgoEstimate(_Message):
    """Where the navigator believes the reference point to be (10 Hz on the tape)."""

    time_ns: int
    position_m: Floats
    """Shape (2,), route frame N, [m]."""
    heading_rad: float
    speed_mps: float
    """Signed, forward positive."""
    yaw_rate_radps: float
    roll_rad: float
    pitch_rad: float
    position_sd_m: float
    heading_sd_rad: float


@dataclass(frozen=True, eq=False)
class Decision(_Message):
    """What the high-level controller decided and why (10 Hz)."""

    time_ns: int
    state: str
    reason: str
    """Why this state was entered."""
    replanned: str
    """Why a new local path was made (Fig. 6.4), or empty."""
    waypoint: int
    """Index of the waypoint ahead."""
    goal_rad: float
    """phi(k), heading to the goal point, route frame N."""
    decision_rad: float
    """theta_D(k), route frame N."""
    selected: str
    """`safe` or `real` (Table 6.1), or empty on the smooth path."""
    D1_m: float
    """Free distance straight ahead."""
    D_m: float
    """Free distance along the planned path."""
    V0_mps: float
    """Speed limit in force."""
    speed_mps: float
    """V_s(k), equation (6.8)."""
    cross_track_m: float
    """Signed offset of the estimate from the smooth path of the route, left positive."""


@dataclass(frozen=True, eq=False)
class ObstacleCells(_Message):
    """Occupied cells of the local grid map (1 Hz on the tape)."""

    time_ns: int
    position_m: Floats
    """Shape (n, 2), cell centres, route frame N, [m]."""
    confidence: Floats
    """Shape (n,), 0 to 1."""


DEVICES: dict[type[Any], str] = {
    SonarScan: "sonar", RadarTracks: "radar", GpsFix: "gps", ImuSample: "imu",
    CompassHeading: "compass", RoadEstimate: "road_camera", VehicleState: "odometry",
}  # fmt: skip
"""What each kind of sensor message comes from; a scan names its scanner itself."""

SensorMessage = (
    LidarScan | SonarScan | RadarTracks | GpsFix | ImuSample | CompassHeading | RoadEstimate
    | VehicleState
)  # fmt: skip
Command = FollowPath | UnitOperation | DirectCommand
Report = Command | EgoEstimate | Decision | ObstacleCells
Message = SensorMessage | ActuatorTargets | Report

MESSAGE_TYPES: tuple[type[Any], ...] = (
    LidarScan, SonarScan, RadarTracks, GpsFix, ImuSample, CompassHeading, RoadEstimate,
    VehicleState, ActuatorTargets, FollowPath, UnitOperation, DirectCommand, EgoEstimate, Decision,
    ObstacleCells,
)  # fmt: skip


def device(message: SensorMessage) -> str:
    """The name of the device that a message comes from, as resets and ablations call it."""
    return message.sensor if isinstance(message, LidarScan) else DEVICES[type(message)]


class Outputs(NamedTuple):
    """What one call of the navigator gives: targets for the actuators, reports for the tape."""

    targets: ActuatorTargets
    reports: tuple[Report, ...]


class Navigator(Protocol):
    """Anything that drives: called every 20 ms."""

    def step(self, time_ns: int, messages: Sequence[SensorMessage]) -> Outputs:
        """Take all messages since the last call, in order of delivery; say what to do."""
        ...


class DriveByWire(Protocol):
    """Anything that takes targets: the twin's shim or the truck's CAN bus."""

    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Put the targets into force at `time_ns`; they lapse when no more arrive."""
        ...
