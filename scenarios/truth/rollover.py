"""A tilt table: at which angle the uphill wheels leave it."""

import mujoco
import numpy as np

from scenarios.truth.check import Check, Curve, Range
from scenarios.truth.rig import Rig, plane
from twin.vehicle import TRACK_M

MANUAL_DEG = 15.0
STEP_DEG = 1.0


def static_rollover() -> Check:
    """Against the geometry: half the track beside the height of the centre of mass."""
    rig = Rig(plane(friction=3.0)).drive(1.0, brake=1.0)
    model, data = rig.plant.model, rig.plant.data
    tilt, load = [0.0], [1.0]
    while load[-1] > 0.01 and tilt[-1] < 60.0:
        tilt.append(tilt[-1] + STEP_DEG)
        angle = np.radians(tilt[-1])
        model.opt.gravity[:] = 9.81 * np.array([0.0, -np.sin(angle), -np.cos(angle)])
        rig.drive(0.4, brake=1.0)
        load.append(_uphill(rig))
    height = float(data.subtree_com[0, 2]) if data.subtree_com[0, 2] > 0.1 else 0.6
    rigid = float(np.degrees(np.arctan(0.5 * TRACK_M / height)))
    curve = Curve(np.array(tilt), "tilt [deg]", "load uphill, share", {"twin": np.array(load)})
    return Check(
        title="Static roll-over: tilt at which the uphill wheels carry nothing", unit="deg",
        twin=tilt[-1], allowed=Range(max(MANUAL_DEG, 0.8 * rigid), 1.02 * rigid), grade="published",
        source=f"the manual allows {MANUAL_DEG:.0f} degrees; a rigid vehicle of this track and "
        f"height of centre of mass would tip at {rigid:.0f} (computed)",
        remark="On springs it tips earlier than rigid.", curve=curve,
    )  # fmt: skip


def _uphill(rig: Rig) -> float:
    """Load of the left wheels, which are uphill, as a share of what they carry on level ground."""
    model, data = rig.plant.model, rig.plant.data
    left, total, force = 0.0, 0.0, np.zeros(6)
    for k in range(data.ncon):
        mujoco.mj_contactForce(model, data, k, force)
        names = [model.geom(int(g)).name for g in data.contact.geom[k]]
        total += force[0]
        left += force[0] if any(name.endswith("left_tire") for name in names) else 0.0
    return 2.0 * left / max(total, 1.0)
