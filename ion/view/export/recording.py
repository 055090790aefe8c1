"""A drive drawn step by step into the recording that the viewer's own client plays.

A recording cannot move the camera and leave it to people too. So the world moves, and the vehicle
stays in the middle, heading up the screen: whoever turns the picture goes on looking at it.
"""

from collections.abc import Callable

import numpy as np
import viser
from viser import _messages as messages

from ion.view.cameras import follow
from ion.view.export.beneath import beneath
from ion.view.page import look
from ion.view.places import Pose, quaternion
from ion.view.show import Show
from ion.view.stage import Stage

ROOT = "/world"
STEP_S, SENSED_STEPS = 0.1, 5
"""The vehicle moves ten times a second, what sensors see twice."""
Passed = Callable[[float], None]
"""Is told how far the recording is, [s]."""


def recorded_html(
    server: viser.ViserServer, show: Show, span_s: tuple[float, float], passed: Passed
) -> str:
    """The client's page with the recording in it.

    Args:
        server: that nobody looks at; its scene is drawn in.
        show: what is shown, its timeline complete.
        span_s: from when to when.
        passed: may raise to end it.
    """
    root = server.scene.add_frame(ROOT, show_axes=False)
    look(server)
    _aim(server)
    stage = Stage(beneath(server.scene, ROOT), show, "float16")
    stage.tracks(span_s[1])
    serializer = server.get_scene_serializer()
    for k, time_s in enumerate(np.arange(span_s[0], span_s[1], STEP_S).tolist()):
        moment = show.timeline.at(time_s)
        if pose := stage.move(moment):
            root.position, root.wxyz = _around(pose)
        if k % SENSED_STEPS == 0:
            stage.sense(moment)
        _tell(server, time_s)
        serializer.insert_sleep(STEP_S)
        passed(time_s)
    return serializer.as_html()


def _aim(server: viser.ViserServer) -> None:
    """Where one looks from at first: from behind."""
    view = follow(Pose(np.zeros(3), np.eye(3)))
    server.initial_camera.position = tuple(view.position_m.tolist())
    server.initial_camera.look_at = tuple(view.look_at_m.tolist())


def _around(pose: Pose) -> tuple[np.ndarray, np.ndarray]:
    """The frame of a world that has the vehicle in its middle, heading along x."""
    heading = np.arctan2(pose.axes[1, 0], pose.axes[0, 0])
    c, s = np.cos(heading), np.sin(heading)
    level = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return -level @ pose.position_m, quaternion(level)


def _tell(server: viser.ViserServer, time_s: float) -> None:
    """Let the page's own script know how late it is: a recording has no other voice."""
    source = f"window.ion && ion.at({time_s:.1f})"
    server.scene._websock_interface.queue_message(messages.RunJavascriptMessage(source=source))
