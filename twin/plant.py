"""The vehicle in motion: shim, drivetrain and MuJoCo, one physics step at a time."""

from collections.abc import Mapping, Sequence
from math import hypot

import mujoco
import numpy as np

from nav.messages import ActuatorTargets, Gear
from twin import clock, tire_collision
from twin.body import CONTROL_S, Body, Start
from twin.brush import Brush, resisted
from twin.drive_by_wire import DriveByWire, DriveByWireParameters
from twin.drivetrain import DrivetrainParameters, Engine, friction_torques, wheel_torques
from twin.faults import Faults
from twin.linkage import Gearbox, GearboxParameters
from twin.truth import Applied
from twin.vehicle import SIDES, WHEELS, ackermann, actuators, linkage, tire_contact, tire_geoms
from twin.world import Obstacle

_SPEED_LEVEL_MPS = 0.05

tire_collision.install()  # here, so that a plant out of a pickle finds it in any process


class Plant(Body):
    """The Ranger in a compiled world.

    Args:
        model: holds the vehicle (models/polaris_ranger_6x6.xml); see `Body`.
        start: see `Body`.
        seed: draws how long each shift takes.
        owners: see `Body`.
        steering_gain: the front wheels turn so many times as far as `linkage` says.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        start: Start,
        seed: int,
        owners: Mapping[str, str] | None = None,
        *,
        gear: Gear = Gear.HIGH,
        drivetrain: DrivetrainParameters | None = None,
        drive_by_wire: DriveByWireParameters | None = None,
        gearbox: GearboxParameters | None = None,
        steering_gain: float = 1.0,
    ) -> None:
        super().__init__(model, start, owners or {}, "ranger", WHEELS)
        self._actuators, self._tire_geom = actuators(model), tire_geoms(model)
        self._drivetrain = drivetrain or DrivetrainParameters()
        self._engine = Engine(self._drivetrain, CONTROL_S)
        self._steering_gain = steering_gain
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=tuple(b"gearbox")))
        self._shim = DriveByWire(
            drive_by_wire or DriveByWireParameters(),
            Gearbox(gearbox or GearboxParameters(), rng, gear),
            CONTROL_S,
        )
        self._brush: Brush | None = None
        self._brake = -1.0
        self._level = -1

    def surround(self, things: Sequence[Obstacle]) -> None:
        """See `Body`; brush holds the vehicle back."""
        super().surround(things)
        bushes = [o for o in self._within_reach(things) if o.kind == "brush"]
        self._brush = Brush(bushes) if bushes else None

    def fail(self, faults: Faults) -> None:
        """Let what fails among the actuators fail."""
        self._shim.faults = faults

    @property
    def applied(self) -> Applied:
        """What the actuators do at this instant."""
        return self._shim.applied

    @property
    def gearbox(self) -> Gearbox:
        """The linkage; its parameters may be changed on the way."""
        return self._shim.gearbox

    @property
    def drive_torque_n_m(self) -> float:
        """Of the driveline at this instant, all wheels together, [N m]."""
        return float(self.data.ctrl[self._actuators][len(SIDES) :].sum())

    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Hand targets to the drive-by-wire unit."""
        self._shim.apply(time_ns, targets)

    def _control(self) -> None:
        """Let actuators, engine, air and tires answer to the present speed."""
        velocity = self._velocity()
        speed = self._ahead(velocity)
        self._actuate(self._shim.step(clock.time_ns(self.k), speed), speed)
        self._drag(velocity)
        self._soften(abs(speed))

    def _actuate(self, applied: Applied, speed: float) -> None:
        gear = Gear.NEUTRAL if applied.shifting else applied.gear
        force = self._engine.force(applied.throttle, gear, speed)
        self._hold(applied.steering_rad, force, applied.brake)

    def _hold(self, steering_rad: float, force_n: float, brake: float) -> None:
        """Put the steering, a tractive force of all wheels together and the brakes into force."""
        data, at, p = self.data, self._at, self._drivetrain
        spin = data.qvel.take(at.spin_dof).tolist()
        data.ctrl[self._actuators] = (
            *ackermann(self._steering_gain * linkage(steering_rad)),
            *wheel_torques(p, force_n, spin),
        )
        if brake != self._brake:
            self._brake = brake
            self.model.dof_frictionloss[at.spin_dof] = friction_torques(p, brake)

    def _soften(self, speed: float) -> None:
        level = int(speed / _SPEED_LEVEL_MPS)
        if level != self._level:
            self._level = level
            solref, solimp = tire_contact(level * _SPEED_LEVEL_MPS)
            self.model.geom_solref[self._tire_geom] = solref
            self.model.geom_solimp[self._tire_geom, :2] = solimp

    def _drag(self, velocity: list[float]) -> None:
        vx, vy, vz = velocity
        speed = hypot(vx, vy, vz)
        scale = -self._drivetrain.drag_n_s2_m2 * speed
        force = scale * vx, scale * vy, scale * vz
        if self._brush:
            x, y, _ = self.data.site_xpos[self._at.site["imu"]].tolist()
            force = resisted(force, velocity, self._brush.drag_n(x, y, speed))
        self.data.xfrc_applied[self._at.body, :3] = force
