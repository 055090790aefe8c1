"""The vehicle: a body of boxes on wheels that steer, roll and follow the suspension."""

import numpy as np
import viser

from ion.view.places import Floats, Pose, quaternion
from ion.view.shapes import cylinder, rgb
from ion.view.timeline import Moment
from nav.fusion.scan_geometry import rotation
from nav.parameters import ION
from nav.parameters.vehicle import VehicleParameters

RED, DARK, SEAT, METAL = "#a32c2a", "#2e2d2b", "#4a4744", "#8d8a83"
Part = tuple[tuple[float, float, float], tuple[float, float, float], str]
"""Half size and centre in the vehicle frame [m], colour."""
ION_PARTS: tuple[Part, ...] = (
    ((0.35, 0.55, 0.18), (1.70, 0.0, 0.80), RED),
    ((1.50, 0.45, 0.08), (0.575, 0.0, 0.42), DARK),
    ((0.25, 0.60, 0.30), (0.45, 0.0, 0.75), SEAT),
    ((0.55, 0.70, 0.16), (-0.38, 0.0, 0.82), RED),
    ((0.05, 0.60, 0.08), (2.04, 0.0, 0.50), DARK),
    ((0.70, 0.70, 0.03), (0.75, 0.0, 1.90), METAL),
    *(((0.03, 0.03, 0.55), (x, y, 1.37), METAL) for x in (0.08, 1.42) for y in (-0.66, 0.66)),
)
"""The visual geoms of `models/polaris_ranger_6x6.xml`, and posts for the roof."""
ION_WHEELS = ((1.70, 0.62), (0.59, 0.62), (-0.59, 0.62))
"""x and y of the left wheels, by `models/polaris_ranger_6x6.xml`."""
STEERED = 2
"""The first wheels on the tape are those that steer."""


class VehicleScene:
    """Draws one vehicle.

    Args:
        scene: drawn in.
        name: of the vehicle, as `scenarios.vehicles` calls it.
        vehicle: its parameters.
        height_m: of its body.
    """

    def __init__(
        self, scene: viser.SceneApi, name: str, vehicle: VehicleParameters, height_m: float
    ) -> None:
        self._scene, self._vehicle = scene, vehicle
        self._frame = scene.add_frame("/vehicle", show_axes=False)
        self._steers = name == ION
        self._nominal_m = _nominal(vehicle, self._steers)
        self._wheels: list[viser.BatchedMeshHandle] = []
        for k, part in enumerate(ION_PARTS if self._steers else (_block(vehicle, height_m),)):
            half, centre, color = part
            size = 2.0 * np.array(half)
            scene.add_box(f"/vehicle/part{k}", rgb(color), size, position=centre, cast_shadow=False)

    def show(self, moment: Moment, pose: Pose) -> None:
        """Put it where it is at a moment."""
        self._frame.position, self._frame.wxyz = pose.position_m, quaternion(pose.axes)
        centre_m = self._centres(moment, pose)
        if not len(centre_m):
            return
        if not self._wheels:
            self._wheels = [
                _tires(self._scene, self._vehicle, len(centre_m), hub) for hub in (0, 1)
            ]
        turned = np.array([self._turn(moment, k) for k in range(len(centre_m))], np.float32)
        for handle in self._wheels:
            handle.batched_positions = centre_m.astype(np.float32)
            handle.batched_wxyzs = turned

    def _centres(self, moment: Moment, pose: Pose) -> Floats:
        """Of the wheels in the vehicle frame, shape (n, 3)."""
        if moment.truth and len(moment.truth.tire_center_m) >= len(self._nominal_m):
            return pose.to_vehicle(moment.truth.tire_center_m)
        return self._nominal_m

    def _turn(self, moment: Moment, k: int) -> Floats:
        """Orientation of wheel k: rolled about its axle, then steered; w x y z."""
        rolled_m = moment.rolled_m[k] if k < len(moment.rolled_m) else 0.0
        steers = self._steers and k < STEERED and moment.vehicle is not None
        angle = moment.vehicle.steering_rad if steers and moment.vehicle else 0.0
        return quaternion(rotation(0.0, rolled_m / self._vehicle.wheel_radius_m, angle))


def _block(vehicle: VehicleParameters, height_m: float) -> Part:
    """The outline as one box, clear of the ground."""
    box, low = vehicle.outline, 0.5 * vehicle.wheel_radius_m
    half = (0.5 * (box.front_m - box.rear_m), box.half_width_m, 0.5 * (height_m - low))
    return half, (0.5 * (box.front_m + box.rear_m), 0.0, 0.5 * (height_m + low)), RED


def _nominal(vehicle: VehicleParameters, ion: bool) -> Floats:
    """Where the wheels are at rest, shape (n, 3), left and right in turn."""
    base, side = vehicle.wheelbase_m, 0.5 * vehicle.track_m
    rows = ION_WHEELS if ion else ((base, side), (-base, side))
    r = vehicle.wheel_radius_m
    return np.array([(x, sign * y, r) for x, y in rows for sign in (1.0, -1.0)])


def _tires(
    scene: viser.SceneApi, vehicle: VehicleParameters, count: int, hub: int
) -> viser.BatchedMeshHandle:
    """Tires, or the square hubs that let them be seen to roll."""
    r = vehicle.wheel_radius_m
    mesh = cylinder()
    upright = mesh.vertex_m @ rotation(-0.5 * np.pi, 0.0, 0.0).T
    size = np.array([0.55 * r, 0.42 * r, 0.16 * r]) if hub else np.array([r, 0.38 * r, r])
    return scene.add_batched_meshes_simple(
        f"/vehicle/{'hubs' if hub else 'tires'}",
        upright * size,
        mesh.face,
        batched_wxyzs=np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)),
        batched_positions=np.zeros((count, 3)),
        batched_colors=rgb(METAL if hub else DARK),
        flat_shading=True,
        lod="off",
        cast_shadow=False,
    )
