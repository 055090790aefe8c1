"""Where one looks from."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ion.view.places import Floats, Pose


class View(NamedTuple):
    """A camera, world frame, [m]."""

    position_m: Floats
    look_at_m: Floats


def follow(pose: Pose) -> View:
    """From behind and above, level whatever the vehicle does."""
    return _level(pose, (-9.5, 0.0, 4.6), (5.0, 0.0, 0.6))


def above(pose: Pose) -> View:
    """From the sky, the heading up."""
    return _level(pose, (7.0, 0.0, 42.0), (7.5, 0.0, 0.0))


def driver(pose: Pose) -> View:
    """From the driver's seat: it rolls and pitches with the vehicle."""
    eye, ahead = pose.to_world(np.array([[0.75, 0.35, 1.55], [12.0, 0.35, 0.6]]))
    return View(eye, ahead)


FOLLOW, FREE = "follow", "free"
CAMERAS: dict[str, Callable[[Pose], View]] = {
    FOLLOW: follow, "above": above, "driver's seat": driver,
}  # fmt: skip
"""By the name that people choose; with `free` they move it themselves."""


def _level(pose: Pose, eye: tuple[float, ...], at: tuple[float, ...]) -> View:
    """Both given in a frame that only heads as the vehicle does."""
    heading = np.arctan2(pose.axes[1, 0], pose.axes[0, 0])
    c, s = np.cos(heading), np.sin(heading)
    axes = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return View(*(pose.position_m + axes @ np.array(place) for place in (eye, at)))
