"""The vehicle in motion: shim, drivetrain and MuJoCo, one physics step at a time."""

from collections.abc import Mapping
from math import atan2, cos, hypot, sin

import mujoco
import numpy as np
from numpy.typing import NDArray

from nav.messages import ActuatorTargets, Gear
from twin import clock, tire_collision
from twin.drive_by_wire import DriveByWire, DriveByWireParameters
from twin.drivetrain import (
    DrivetrainParameters,
    Engine,
    Gearbox,
    GearboxParameters,
    friction_torques,
    wheel_torques,
)
from twin.truth import Applied, Truth
from twin.vehicle import ackermann, indices, linkage, tire_contact

Floats = NDArray[np.float64]

GROUND = "ground"
CONTROL_STEPS = 3
"""Physics steps from one turn of drive-by-wire, engine and drag to the next: 100 Hz. The fastest of
them, the coupling of the wheels, has 85 ms."""
CONTROL_S = CONTROL_STEPS * clock.STEP_S
_SPEED_LEVEL_MPS = 0.05
_CHASSIS, _OBSTACLE, _SOFT = 1, 2, 3
_SITE = mujoco.mjtObj.mjOBJ_SITE

tire_collision.install()  # here, so that a plant out of a pickle finds it in any process


class Plant:
    """The Ranger in a compiled world. Picklable in the middle; goes on with the same bits.

    Positions, velocities and contacts in `data` are those of step `k`: each step ends with
    `mj_step1`, whose counterpart begins the next.

    Args:
        model: holds the vehicle (models/polaris_ranger_6x6.xml) and, already in place, the ground
            with its friction; the plant keeps and edits the model as its own.
        start: x, y and ground height [m] of the reference point, heading [rad].
        seed: draws how long each shift takes.
        owners: geom name to the thing it is a part of; `""` for what may be touched.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        start: tuple[float, float, float, float],
        seed: int,
        owners: Mapping[str, str] | None = None,
        *,
        gear: Gear = Gear.HIGH,
        drivetrain: DrivetrainParameters | None = None,
        drive_by_wire: DriveByWireParameters | None = None,
        gearbox: GearboxParameters | None = None,
    ) -> None:
        self.model = model
        self.k = 0
        self._at = indices(model)
        self._drivetrain = drivetrain or DrivetrainParameters()
        self._engine = Engine(self._drivetrain, CONTROL_S)
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=tuple(b"gearbox")))
        self._shim = DriveByWire(
            drive_by_wire or DriveByWireParameters(),
            Gearbox(gearbox or GearboxParameters(), rng, gear),
            CONTROL_S,
        )
        self._kind, self._owner = _geoms(model, owners or {}, self._at.body)
        self._touched: dict[str, None] = {}
        self._brake = -1.0
        self._level = -1
        self.data = mujoco.MjData(model)
        self._place(start)

    def _place(self, start: tuple[float, float, float, float]) -> None:
        x, y, z, heading = start
        mujoco.mj_resetDataKeyframe(self.model, self.data, self.model.key("parked").id)
        at = self._at.free_qpos
        self.data.qpos[at : at + 3] += (x, y, z)
        self.data.qpos[at + 3 : at + 7] = (cos(0.5 * heading), 0.0, 0.0, sin(0.5 * heading))
        mujoco.mj_forward(self.model, self.data)
        self._lift()

    def _lift(self) -> None:
        """Let the vehicle drop onto uneven ground; a tire that starts in it would be thrown."""
        dist = self.data.contact.dist
        self.data.qpos[self._at.free_qpos + 2] += max(0.0, -dist.min()) if len(dist) else 0.0
        mujoco.mj_forward(self.model, self.data)

    # ------------------------------------------------------------ driving

    @property
    def applied(self) -> Applied:
        """What the actuators do at this instant."""
        return self._shim.applied

    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Hand targets to the drive-by-wire unit."""
        self._shim.apply(time_ns, targets)

    def step(self) -> None:
        """One physics step of 1/300 s; positions, velocities and contacts are fresh after it."""
        if self.k % CONTROL_STEPS == 0:
            self._control()
        mujoco.mj_step2(self.model, self.data)
        mujoco.mj_step1(self.model, self.data)
        self.k += 1
        self._touch()

    def _control(self) -> None:
        """Let actuators, engine, air and tires answer to the present speed."""
        velocity = self._velocity()
        speed = self._ahead(velocity)
        self._actuate(self._shim.step(clock.time_ns(self.k), speed), speed)
        self._drag(velocity)
        self._soften(abs(speed))

    def _actuate(self, applied: Applied, speed: float) -> None:
        data, at, p = self.data, self._at, self._drivetrain
        gear = Gear.NEUTRAL if applied.shifting else applied.gear
        force = self._engine.force(applied.throttle, gear, speed)
        spin = data.qvel.take(at.spin_dof).tolist()
        data.ctrl[at.actuators] = (
            *ackermann(linkage(applied.steering_rad)), *wheel_torques(p, force, spin),
        )  # fmt: skip
        if applied.brake != self._brake:
            self._brake = applied.brake
            self.model.dof_frictionloss[at.spin_dof] = friction_torques(p, applied.brake)

    def _soften(self, speed: float) -> None:
        level = int(speed / _SPEED_LEVEL_MPS)
        if level != self._level:
            self._level = level
            solref, solimp = tire_contact(level * _SPEED_LEVEL_MPS)
            self.model.geom_solref[self._at.tire_geom] = solref
            self.model.geom_solimp[self._at.tire_geom, :2] = solimp

    def _drag(self, velocity: list[float]) -> None:
        vx, vy, vz = velocity
        scale = -self._drivetrain.drag_n_s2_m2 * hypot(vx, vy, vz)
        self.data.xfrc_applied[self._at.body, :3] = (scale * vx, scale * vy, scale * vz)

    def _touch(self) -> None:
        geom = self.data.contact.geom
        if np.count_nonzero(self._kind.take(geom)):
            for a, b in geom.tolist():
                self._note(a, b)

    def _note(self, a: int, b: int) -> None:
        kinds = (self._kind[a], self._kind[b])
        if _OBSTACLE in kinds:
            self._touched[self._owner.get(a) or self._owner[b]] = None
        elif _CHASSIS in kinds and _SOFT not in kinds:
            self._touched[GROUND] = None

    # ------------------------------------------------------------ looking

    @property
    def speed_mps(self) -> float:
        """Speed of the reference point along the vehicle's x axis, signed, [m/s]."""
        return self._ahead(self._velocity())

    def _velocity(self) -> list[float]:
        """Of the reference point, world axes, [m/s]."""
        return self.data.qvel[self._at.free_dof : self._at.free_dof + 3].tolist()

    def _ahead(self, velocity: list[float]) -> float:
        """A velocity's part along the vehicle's x axis."""
        vx, vy, vz = velocity
        fx, fy, fz = self.data.xmat[self._at.body, 0::3].tolist()
        return vx * fx + vy * fy + vz * fz

    @property
    def wheel_speed_radps(self) -> Floats:
        """Shape (6,), signed, [rad/s]; front left, front right, middle l, r, rear l, r."""
        return self.data.qvel.take(self._at.spin_dof)

    def site_pose(self, name: str) -> tuple[Floats, Floats]:
        """World position (3,) [m] and rotation (3, 3), site to world."""
        site, data = self._at.site[name], self.data
        return data.site_xpos[site].copy(), data.site_xmat[site].reshape(3, 3).copy()

    def site_velocity(self, name: str) -> tuple[Floats, Floats]:
        """Linear (3,) [m/s] and angular velocity (3,) [rad/s] of a site, world axes."""
        site, velocity = self._at.site[name], np.empty(6)
        mujoco.mj_objectVelocity(self.model, self.data, _SITE, site, velocity, 0)
        return velocity[3:], velocity[:3]

    def imu(self) -> tuple[Floats, Floats]:
        """Angular rate (3,) [rad/s] and specific force (3,) [m/s^2], vehicle frame."""
        at, data = self._at, self.data.sensordata
        gyro, accelerometer = at.gyro, at.accelerometer
        return data[gyro : gyro + 3].copy(), data[accelerometer : accelerometer + 3].copy()

    def truth(self) -> Truth:
        """The true state now, with the contacts since the last call."""
        data, at = self.data, self._at
        R = data.xmat[at.body].tolist()
        contacts, self._touched = tuple(self._touched), {}
        return Truth(
            time_ns=clock.time_ns(self.k),
            position_m=data.xpos[at.body].copy(),
            heading_rad=atan2(R[3], R[0]),
            roll_rad=atan2(R[7], R[8]),
            pitch_rad=atan2(-R[6], hypot(R[0], R[3])),
            speed_mps=self.speed_mps,
            tire_center_m=data.xpos.take(at.wheel_body, axis=0),
            contacts=contacts,
        )


def _geoms(
    model: mujoco.MjModel, owners: Mapping[str, str], vehicle: int
) -> tuple[NDArray[np.int8], dict[int, str]]:
    """What each geom is to a judge, and the owners of the obstacles, by geom id."""
    kind = np.zeros(model.ngeom, np.int8)
    kind[model.geom_bodyid == vehicle] = _CHASSIS
    owner = {model.geom(name).id: owner for name, owner in owners.items()}
    for geom, name in owner.items():
        kind[geom] = _OBSTACLE if name else _SOFT
    return kind, owner
