"""The drive-by-wire unit: from targets that arrive to positions that the actuators reach.

Numbers with unit, source and grade: models/README.md.
"""

from dataclasses import dataclass, field
from math import isfinite

from nav.messages import ActuatorTargets, Gear
from twin.faults import Faults
from twin.linkage import Gearbox
from twin.servo import Servo, ServoParameters
from twin.truth import Applied
from twin.vehicle import STEERING_LIMIT_RAD

TEN_BITS, EIGHT_BITS = 1023, 255
STEERING = ServoParameters(
    low=-STEERING_LIMIT_RAD, high=STEERING_LIMIT_RAD, rate_per_s=0.288, delay_s=0.30,
    count=2.0 * STEERING_LIMIT_RAD / TEN_BITS, dead_band=0.003, unpowered=None,
)  # fmt: skip
THROTTLE = ServoParameters(
    low=0.0, high=1.0, rate_per_s=2.0, delay_s=0.10,
    count=1.0 / EIGHT_BITS, dead_band=0.006, unpowered=0.0,
)  # fmt: skip
BRAKE = ServoParameters(
    low=0.0, high=1.0, rate_per_s=4.0, delay_s=0.10,
    count=1.0 / EIGHT_BITS, dead_band=0.006, unpowered=0.0,
)  # fmt: skip


@dataclass(frozen=True)
class DriveByWireParameters:
    """Three servos, and the stop when commands stop arriving."""

    steering: ServoParameters = STEERING
    throttle: ServoParameters = THROTTLE
    brake: ServoParameters = BRAKE
    timeout_s: float = 0.5
    """Without targets for this long: throttle closed, brake on."""


@dataclass
class DriveByWire:
    """Delays, ends and rates; stops the vehicle when targets stop arriving."""

    parameters: DriveByWireParameters
    gearbox: Gearbox
    dt_s: float
    """Time from one `step` to the next."""
    faults: Faults = field(default_factory=lambda: Faults(()))
    _alive_until_ns: int = 0

    def __post_init__(self) -> None:
        p = self.parameters
        self._steering = Servo("steering", p.steering, 0.0)
        self._throttle = Servo("throttle", p.throttle, 0.0)
        self._brake = Servo("brake", p.brake, 1.0)
        self._gear = self.gearbox.gear
        self.applied = self._applied()

    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Put the targets into force at `time_ns`; what is not a number counts as not arrived."""
        if not isfinite(targets.steering_rad + targets.throttle + targets.brake):
            return
        self._steering.put(time_ns, targets.steering_rad)
        self._throttle.put(time_ns, targets.throttle)
        self._brake.put(time_ns, targets.brake)
        self._gear = Gear(targets.gear)
        self._alive_until_ns = time_ns + round(self.parameters.timeout_s * 1e9)

    def step(self, time_ns: int, speed_mps: float) -> Applied:
        """Advance by `dt_s`: what the actuators really do at `time_ns`."""
        if time_ns >= self._alive_until_ns:
            self._stop()
        if not self._gear_fails(time_ns):
            self.gearbox.step(self._gear, speed_mps, self.dt_s)
        for servo in (self._steering, self._throttle, self._brake):
            servo.step(time_ns, self.dt_s, self.faults)
        self.applied = self._applied()
        return self.applied

    def _applied(self) -> Applied:
        box = self.gearbox
        positions = self._steering.position, self._throttle.position, self._brake.position
        return Applied(*positions, int(box.gear), box.shifting, box.position)

    def _gear_fails(self, time_ns: int) -> bool:
        """The linkage stays where it is, on its way too."""
        f = self.faults
        return "gear" in f and (f.silent(time_ns, "gear") or f.frozen(time_ns, "gear"))

    def _stop(self) -> None:
        self._throttle.hold(0.0)
        self._brake.hold(1.0)
        self._gear = self.gearbox.gear
