"""A vehicle in motion in MuJoCo: placed, stepped, touched and looked at; how it drives is its own.

What the vehicle's MJCF must have: a body of the vehicle's name whose origin is the reference point,
`<name>_free`, `<wheel>_wheel`, `<wheel>_spin`, `imu_gyro`, `imu_accelerometer`, and a keyframe
`parked`.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from math import atan2, cos, hypot, sin
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from nav.messages import ActuatorTargets
from twin import clock, pool
from twin.pool import Pool
from twin.truth import Applied, Truth
from twin.world import SOFT, Obstacle

Floats = NDArray[np.float64]
Start = tuple[float, float, float, float]
"""x, y and ground height [m] of the reference point, heading [rad]."""

GROUND = "ground"
CONTROL_STEPS = 3
"""Physics steps from one turn of drive-by-wire and motors to the next: 100 Hz. The fastest of
them, the coupling of the Ranger's wheels, has 85 ms."""
CONTROL_S = CONTROL_STEPS * clock.STEP_S
_CHASSIS, _OBSTACLE, _SOFT = 1, 2, 3
_SITE = mujoco.mjtObj.mjOBJ_SITE


class Parts(NamedTuple):
    """Where a vehicle's parts are in the model's arrays."""

    body: int
    free_qpos: int
    free_dof: int
    spin_dof: NDArray[np.int64]
    """Of the wheels, in their order."""
    wheel_body: NDArray[np.int64]
    gyro: int
    accelerometer: int
    site: dict[str, int]


def parts(model: mujoco.MjModel, name: str, wheels: Sequence[str]) -> Parts:
    """Look a vehicle up by name.

    Raises:
        KeyError: the model does not hold it; MuJoCo's message lists the names that exist.
    """
    free = model.joint(f"{name}_free")
    return Parts(
        body=model.body(name).id,
        free_qpos=int(free.qposadr[0]),
        free_dof=int(free.dofadr[0]),
        spin_dof=np.array([model.joint(f"{w}_spin").dofadr[0] for w in wheels]),
        wheel_body=np.array([model.body(f"{w}_wheel").id for w in wheels]),
        gyro=int(model.sensor("imu_gyro").adr[0]),
        accelerometer=int(model.sensor("imu_accelerometer").adr[0]),
        site={model.site(i).name: i for i in range(model.nsite)},
    )


class Body(ABC):
    """A vehicle in a compiled world. Picklable in the middle; goes on with the same bits.

    Positions, velocities and contacts in `data` are those of step `k`: each step ends with
    `mj_step1`, whose counterpart begins the next.

    Args:
        model: holds the vehicle and, already in place, the ground with its friction; it is kept,
            and edited, as the vehicle's own.
        start: where the vehicle is put.
        owners: geom name to the thing it is a part of; `""` for what may be touched.
        name: of the vehicle in the model.
        wheels: their names.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        start: Start,
        owners: Mapping[str, str],
        name: str,
        wheels: Sequence[str],
    ) -> None:
        self.model = model
        self.k = 0
        self._at = parts(model, name, wheels)
        self._kind, self._owner = _geoms(model, owners, self._at.body)
        self._touched: dict[str, None] = {}
        self.data = mujoco.MjData(model)
        self._pool = Pool(model) if pool.is_in(model) else None
        self._place(start)

    def _place(self, start: Start) -> None:
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

    def surround(self, things: Sequence[Obstacle]) -> None:
        """Take what is around; where it streams past, it does not stand in the model yet."""
        if self._pool is None:
            return
        near = self._within_reach(things)
        for geom, thing in self._pool.place(self.model, self.data, near).items():
            soft = thing is None or thing.kind in SOFT
            self._kind[geom] = _SOFT if soft else _OBSTACLE
            self._owner[geom] = "" if thing is None else thing.owner or thing.name

    def _within_reach(self, things: Sequence[Obstacle]) -> Sequence[Obstacle]:
        """Of what streams past only what the vehicle may meet before it looks around again."""
        if self._pool is None:
            return things
        x, y, _ = self.data.xpos[self._at.body].tolist()
        return pool.within_reach(things, (x, y))

    # ------------------------------------------------------------ driving

    @property
    @abstractmethod
    def applied(self) -> Applied:
        """What the actuators do at this instant."""

    @abstractmethod
    def apply(self, time_ns: int, targets: ActuatorTargets) -> None:
        """Hand targets to the drive-by-wire unit."""

    @abstractmethod
    def _control(self) -> None:
        """Let the actuators answer to the present state."""

    def step(self) -> None:
        """One physics step of 1/300 s; positions, velocities and contacts are fresh after it."""
        if self.k % CONTROL_STEPS == 0:
            self._control()
        mujoco.mj_step2(self.model, self.data)
        mujoco.mj_step1(self.model, self.data)
        self.k += 1
        self._touch()

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
        """Shape (n,), signed, [rad/s], in the order of the wheels."""
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
