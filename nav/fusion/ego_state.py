"""The ego state: an extended Kalman filter over GPS, IMU, wheels and compass.

Dead reckoning (yaw rate of the gyro, speed of the wheels) runs forward; every other sensor
corrects it. Any sensor may be missing but the GPS, without which there is no start.
"""

import math
from dataclasses import dataclass

from nav.angles import wrapped
from nav.fusion import ego_gps
from nav.fusion.attitude_history import SILENT_S, AttitudeHistory
from nav.fusion.ego_filter import (
    COMPASS_BIAS,
    GYRO_BIAS,
    HEADING,
    SPEED,
    WHEEL_SCALE,
    Drive,
    Filter,
    Y,
    row,
)
from nav.fusion.ego_kinematics import (
    Attitude,
    attitude_of,
    heading_rate,
    level,
    speed_of_wheels,
)
from nav.fusion.ego_start import Start
from nav.fusion.erection import GRAVITY_MPS2, Erection
from nav.fusion.scan_geometry import Pose
from nav.messages import (
    CompassHeading,
    EgoEstimate,
    Gear,
    GpsFix,
    GpsQuality,
    ImuSample,
    SensorMessage,
    VehicleState,
)
from nav.parameters.ego_state import EgoParameters
from nav.parameters.vehicle import VehicleParameters
from nav.route.geodesy import Frame
from nav.steering_circle import curvature

STANDING, GYRO_AT_REST = row((SPEED, 1.0)), row((GYRO_BIAS, 1.0))
COMPASS = row((COMPASS_BIAS, 1.0), (HEADING, 1.0))
"""What is measured, whatever the state."""
ACCELERATION_S = 0.2
"""Time constant of the acceleration that carries the speed back to a delayed fix."""
WHEELS_SILENT_S = 0.5
"""Wheels that have been silent for longer tell of no acceleration."""


@dataclass
class _Last:
    """What each sensor said last."""

    attitude: Attitude
    imu_ns: int | None = None
    wheels_ns: int | None = None
    speed_mps: float = 0.0
    """The filter's, after the wheels had spoken."""
    fix: GpsFix | None = None
    direction: float = 1.0
    """-1 when the gear says that the wheels turn backwards."""
    brake: float = 0.0
    _acceleration_mps2: float = 0.0

    def acceleration_mps2(self, time_ns: int) -> float:
        """Smoothed; wheels that are silent tell of none."""
        since_s = (time_ns - self.wheels_ns) * 1e-9 if self.wheels_ns is not None else math.inf
        return self._acceleration_mps2 if since_s < WHEELS_SILENT_S else 0.0

    def accelerate(self, time_ns: int, speed_mps: float) -> None:
        """Take a new speed into the smoothed acceleration."""
        if self.wheels_ns is not None and time_ns > self.wheels_ns:
            dt = (time_ns - self.wheels_ns) * 1e-9
            change = (speed_mps - self.speed_mps) / dt - self._acceleration_mps2
            self._acceleration_mps2 += change * min(dt / ACCELERATION_S, 1.0)
        self.wheels_ns, self.speed_mps = time_ns, speed_mps


class EgoState:
    """Where the vehicle is, fused from whatever sensors speak. Picklable."""

    def __init__(
        self,
        parameters: EgoParameters,
        vehicle: VehicleParameters,
        frame: Frame,
        crew_heading_rad: float | None = None,
    ) -> None:
        """`crew_heading_rad`: for a start without a compass, within some 20 degrees; see Start."""
        self.parameters = parameters
        self.vehicle = vehicle
        self.frame = frame
        self.filter = Filter(parameters)
        self._start: Start | None = Start(parameters, crew_heading_rad)
        self._last = _Last(Attitude())
        self._drive = Drive()
        self._erection = Erection(parameters.erection_s)
        self._attitudes = AttitudeHistory()
        self._first_ns: int | None = None
        self._started_ns = 0
        self._time_ns = 0

    @property
    def ready(self) -> bool:
        """Whether position and heading are known and have settled."""
        settled = self._time_ns - self._started_ns >= self.parameters.start.settle_s * 1e9
        return self._start is None and settled

    def update(self, message: SensorMessage) -> None:
        """Take one message, in order of delivery. Scans are of no concern here."""
        if self._first_ns is None:
            self._first_ns = message.time_ns
        if self._start:
            self._begin(self._start, message)
        elif message.time_ns > self._time_ns:
            self._advance(message.time_ns)
        if isinstance(message, ImuSample):
            self._take_imu(message)
        elif isinstance(message, VehicleState):
            self._take_wheels(message)
        elif isinstance(message, GpsFix):
            self._take_fix(message)
        elif isinstance(message, CompassHeading):
            self._take_compass(message)

    def estimate(self, time_ns: int) -> EgoEstimate | None:
        """The ego state at `time_ns`, extrapolated with the present rates; None until `ready`."""
        if not self.ready:
            return None
        x, y, heading, roll, pitch = self.pose_at(time_ns)
        P = self.filter.covariance
        return EgoEstimate(
            time_ns=time_ns,
            position_m=(x, y),  # pyright: ignore[reportArgumentType]  (messages make the array)
            heading_rad=heading,
            speed_mps=float(self.filter.state[SPEED]),
            yaw_rate_radps=self.filter.yaw_rate(self._drive),
            roll_rad=roll,
            pitch_rad=pitch,
            position_sd_m=math.sqrt(0.5 * float(P[0, 0] + P[Y, Y])),
            heading_sd_rad=math.sqrt(float(P[HEADING, HEADING])),
        )

    def pose_at(self, time_ns: int) -> Pose:
        """The pose some milliseconds before or after the newest message; heading in (-pi, pi]."""
        return self._pose(time_ns, self._attitudes.at(time_ns))

    def _pose(self, time_ns: int, attitude: Attitude) -> Pose:
        dt = min(max((time_ns - self._time_ns) * 1e-9, -SILENT_S), SILENT_S)
        x, y, heading, v = self.filter.state[:4].tolist()
        turn = self.filter.yaw_rate(self._drive) * dt
        way = v * dt * self._drive.cos_pitch
        middle = heading + 0.5 * turn
        x, y = x + way * math.cos(middle), y + way * math.sin(middle)
        return Pose(x, y, wrapped(heading + turn), attitude.roll_rad, attitude.pitch_rad)

    @property
    def speed_mps(self) -> float:
        """Signed, forward positive."""
        return float(self.filter.state[SPEED])

    @property
    def rocking_radps(self) -> float:
        """How fast the vehicle rolls and pitches, as the IMU said last."""
        return math.hypot(*self._last.attitude.rate_radps[:2])

    def antenna_gap_m(self, fix: GpsFix) -> tuple[float, float]:
        """How far a fix is from where the antenna is believed to be, and the standard deviation of
        that belief, [m]."""
        attitude = self._attitudes.at(fix.time_ns)
        pose = self._pose(fix.time_ns, attitude)
        forward, left = level(self.vehicle.gps_position_m, attitude)
        c, s = math.cos(pose.heading_rad), math.sin(pose.heading_rad)
        x, y = self.frame.point(fix.latitude_deg, fix.longitude_deg)
        gap = x - pose.x_m - c * forward + s * left, y - pose.y_m - s * forward - c * left
        P = self.filter.covariance
        return math.hypot(*gap), math.sqrt(0.5 * float(P[0, 0] + P[Y, Y]))

    def compass_gap_rad(self, heading_rad: float) -> float:
        """How far a compass is from what is expected of it, [rad]."""
        expected = float(self.filter.state[HEADING]) + float(self.filter.state[COMPASS_BIAS])
        return wrapped(heading_rad - expected)

    def yaw_rate_of(self, steering_rad: float) -> float:
        """The yaw rate that a steering angle gives at the present speed, [rad/s]."""
        return self.speed_mps * curvature(steering_rad, self.vehicle.steering)

    def gps_lost_s(self, time_ns: int) -> float:
        """Time since the last fix [s]; before any, since the first message of all."""
        since = self._last.fix.time_ns if self._last.fix else self._first_ns
        return 0.0 if since is None else max(time_ns - since, 0) * 1e-9

    def refused_s(self, time_ns: int) -> dict[str, float]:
        """For how long each source has been refused by now, [s]; empty while all are believed."""
        since = self.filter.refused_since_ns
        return {name: max(time_ns - since[name], 0) * 1e-9 for name in sorted(since)}

    # ------------------------------------------------------------ start and dead reckoning

    def _begin(self, start: Start, message: SensorMessage) -> None:
        first = start.take(message)
        if first is None or not isinstance(message, GpsFix):
            return
        self._time_ns = self._started_ns = message.time_ns
        self._start = None
        antenna = self.frame.point(message.latitude_deg, message.longitude_deg)
        mount = self.vehicle.gps_position_m
        ego_gps.begin(self.filter, antenna, message.sd_m, first, level(mount, self._last.attitude))

    def _advance(self, time_ns: int) -> None:
        self.filter.predict((time_ns - self._time_ns) * 1e-9, self._drive)
        self._time_ns = time_ns

    def _take_imu(self, sample: ImuSample) -> None:
        attitude = self._upright(attitude_of(sample), sample.time_ns)
        self._last.attitude, self._last.imu_ns = attitude, sample.time_ns
        self._attitudes.add(sample.time_ns, attitude)
        motion = self.parameters.motion
        felt, yaw_q = float(sample.acceleration_mps2[0]), motion.gyro_radps**2
        brisk, braking = max(abs(felt) - motion.brisk_mps2, 0.0), None
        if brisk > 0.0 and self._last.brake > motion.hard_brake:
            brisk *= motion.braking_share
            braking = felt + GRAVITY_MPS2 * math.sin(attitude.pitch_rad)
        cos_pitch = math.cos(attitude.pitch_rad)
        self._drive = Drive(heading_rate(attitude), True, cos_pitch, yaw_q, brisk, braking)

    def _upright(self, measured: Attitude, time_ns: int) -> Attitude:
        """Without what the accelerations have done to the gyro's vertical."""
        if self._start is None and self._last.imu_ns is not None:
            sideward = float(self.filter.state[SPEED]) * heading_rate(measured)
            dt_s = (time_ns - self._last.imu_ns) * 1e-9
            ahead = self._last.acceleration_mps2(time_ns)
            self._erection.follow(sideward, ahead, dt_s)
        return Attitude(
            measured.roll_rad - self._erection.roll_rad,
            measured.pitch_rad - self._erection.pitch_rad,
            measured.rate_radps,
        )

    def _imu_speaks(self, time_ns: int) -> bool:
        last = self._last.imu_ns
        return last is not None and time_ns - last < self.parameters.imu_patience_s * 1e9

    # ------------------------------------------------------------ corrections

    def _take_wheels(self, state: VehicleState) -> None:
        if not self._imu_speaks(state.time_ns):
            self._drive_by_steering(state.time_ns, state.steering_rad)
        if state.gear is not Gear.NEUTRAL and not state.shifting:
            self._last.direction = -1.0 if state.gear is Gear.REVERSE else 1.0
        self._last.brake = state.brake
        wheels = [self._last.direction * w for w in state.wheel_speed_mps.tolist()]
        if self._start is None:
            yaw_rate = self.filter.yaw_rate(self._drive)
            speed = speed_of_wheels(wheels, yaw_rate, self.vehicle)
            slides = self._slides(speed)
            if abs(speed) < self.parameters.wheels.still_mps and not slides:
                self._correct_at_rest(state.time_ns)
            else:
                self._correct_speed(state.time_ns, speed, slides)
            self._last.accelerate(state.time_ns, float(self.filter.state[SPEED]))

    def _drive_by_steering(self, time_ns: int, steering_rad: float) -> None:
        speed, rate = self.speed_mps, self.yaw_rate_of(steering_rad)
        yaw_q = (self.parameters.motion.steering_per_m * speed) ** 2
        self._last.attitude = Attitude(rate_radps=(0.0, 0.0, rate))
        self._attitudes.add(time_ns, self._last.attitude)
        self._drive = Drive(rate, False, 1.0, yaw_q)

    def _slides(self, speed_mps: float) -> bool:
        """Whether wheels may slide under hard brakes: they turn slower then, and never faster."""
        braking, v = self._drive.braking_mps2 is not None, float(self.filter.state[SPEED])
        return braking and abs(speed_mps) < abs(v)

    def _correct_speed(self, time_ns: int, speed_mps: float, slides: bool) -> None:
        p, v = self.parameters.wheels, float(self.filter.state[SPEED])
        scale = 1.0 + float(self.filter.state[WHEEL_SCALE])
        variance = p.sd_mps**2 + (p.sd_share * speed_mps) ** 2
        variance += p.slide_sd_mps**2 if slides else 0.0
        turning = row((SPEED, scale), (WHEEL_SCALE, v))
        self.filter.correct("wheels", time_ns, turning, speed_mps - scale * v, variance)

    def _correct_at_rest(self, time_ns: int) -> None:
        """A counter without sign makes speed of noise: at rest it is 0, and so is the yaw rate."""
        p, v = self.parameters.wheels, float(self.filter.state[SPEED])
        self.filter.correct("wheels", time_ns, STANDING, -v, p.still_sd_mps**2)
        if self._drive.gyro and abs(v) < p.still_mps:
            rate = self.filter.yaw_rate(self._drive)
            self.filter.update(GYRO_AT_REST, rate, p.still_gyro_sd_radps**2)

    def _take_fix(self, fix: GpsFix) -> None:
        if fix.quality is GpsQuality.NONE:
            return
        before, self._last.fix = self._last.fix, fix
        if before is None or self._start or fix.time_ns <= self._started_ns:
            return
        if ego_gps.is_another_offset(self.parameters, fix, before):
            self.filter.redraw_gps_offset()
        mount = self.vehicle.gps_position_m
        attitude = self._attitudes.at(fix.time_ns)
        ego_gps.correct_velocity(self.filter, fix, self._past(fix.time_ns, attitude), mount)
        antenna = self.frame.point(fix.latitude_deg, fix.longitude_deg)
        past = self._past(fix.time_ns, attitude)
        ego_gps.correct_position(self.filter, antenna, fix, past, mount)

    def _past(self, time_ns: int, attitude: Attitude) -> ego_gps.Past:
        """The vehicle at a fix's time, from the present state and rates."""
        age = (self._time_ns - time_ns) * 1e-9
        pose = self._pose(time_ns, attitude)
        level_speed = self._drive.cos_pitch * float(self.filter.state[SPEED])
        speed = level_speed - self._last.acceleration_mps2(self._time_ns) * age
        return ego_gps.Past(pose.x_m, pose.y_m, pose.heading_rad, speed, attitude, age)

    def _take_compass(self, compass: CompassHeading) -> None:
        if self._start:
            return
        age = (self._time_ns - compass.time_ns) * 1e-9
        heading, bias = float(self.filter.state[HEADING]), float(self.filter.state[COMPASS_BIAS])
        expected = heading - self.filter.yaw_rate(self._drive) * age + bias
        innovation = wrapped(compass.heading_rad - expected)
        variance = self.parameters.compass.sd_rad**2
        self.filter.correct("compass", compass.time_ns, COMPASS, innovation, variance)
