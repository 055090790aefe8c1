"""Lines and points in the scene that change from moment to moment."""

from typing import Literal

import numpy as np
import viser
from numpy.typing import NDArray

from ion.view.shapes import rgb
from nav.messages import Floats

Colors = NDArray[np.uint8]
Precision = Literal["float16", "float32"]


class Canvas:
    """Keeps what is drawn by name, and changes it in place: nothing flickers.

    Args:
        scene: drawn in.
        groups: names of what can be hidden together, such as `/lidar`.
        precision: of points, from their middle: half floats take half the room and err by up to
            3 cm at 60 m.
    """

    def __init__(
        self, scene: viser.SceneApi, groups: tuple[str, ...], precision: Precision = "float32"
    ) -> None:
        self._scene = scene
        self._precision: Precision = precision
        self._groups = {name: scene.add_frame(name, show_axes=False) for name in groups}
        self._lines: dict[str, viser.LineSegmentsHandle] = {}
        self._points: dict[str, viser.PointCloudHandle] = {}

    def hide(self, group: str, hidden: bool) -> None:
        """Hide or show a group."""
        if self._groups[group].visible == hidden:
            self._groups[group].visible = not hidden

    def lines(self, name: str, segment_m: Floats, color: str, width_px: float) -> None:
        """Segments (n, 2, 3), n may be 0, in place of those of the same name."""
        known = self._lines.get(name)
        if known is None and len(segment_m):
            self._lines[name] = lines(self._scene, name, segment_m, color, width_px)
        elif known is not None:
            known.visible = bool(len(segment_m))
            if len(segment_m):
                known.points = segment_m.astype(np.float32)
                known.colors = np.array(rgb(color), np.uint8)

    def points(self, name: str, place_m: Floats, color: str | Colors, size_m: float) -> None:
        """Points (n, 3), n may be 0, in one colour or each in its own (n, 3)."""
        known = self._points.get(name)
        if known is not None:
            known.visible = bool(len(place_m))
        if not len(place_m):
            return
        colors = np.array(rgb(color), np.uint8) if isinstance(color, str) else color
        middle_m = place_m.mean(axis=0)
        near = (place_m - middle_m).astype(self._precision)
        if known is None:
            known = self._points[name] = self._scene.add_point_cloud(
                name, near, colors, point_size=size_m, point_shape="circle",
                precision=self._precision, point_shading="flat",
            )  # fmt: skip
        else:
            known.points, known.colors = near, colors
        known.position = middle_m


def lines(
    scene: viser.SceneApi, name: str, segment_m: Floats, color: str, width_px: float
) -> viser.LineSegmentsHandle:
    """Segments (n, 2, 3) of one colour."""
    return scene.add_line_segments(
        name, segment_m, rgb(color), thickness=width_px, thickness_units="screen"
    )
