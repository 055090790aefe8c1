"""The page: a scene, a panel beside it, and the loop that moves both on."""

from pathlib import Path
from time import monotonic

import numpy as np
import viser
from numpy.typing import NDArray

from ion.view.cameras import CAMERAS, FREE
from ion.view.decide.deciding import Deciding
from ion.view.panel import Panel
from ion.view.places import Pose
from ion.view.shapes import rgb
from ion.view.show import Show
from ion.view.stage import Stage

SKY = "#8fb4d6", "#e9eef0"
"""From above to below."""
FRAME_S = 0.08
"""From one picture to the next while it plays."""
IDLE_S = 0.2
"""While it stands: more of the tape may have been read."""


class Page:
    """Draws a drive on a server.

    Args:
        server: of the web page.
        show: what is shown.
        tuned: where tuned parameter files go.

    Raises:
        TapeError: the course that was driven is not known here.
    """

    def __init__(self, server: viser.ViserServer, show: Show, tuned: Path) -> None:
        self._server, self._show = server, show
        self._pose: Pose | None = None
        look(server)
        server.gui.configure_theme(control_width="large", show_logo=False, show_share_button=False)
        server.gui.main_panel.dock_right()
        self._stage = Stage(server.scene, show)
        self._panel = Panel(server.gui, show, show.title(self._stage.course))
        self._deciding = Deciding(server, show, tuned)
        server.on_client_connect(lambda client: self._aim(client, self._panel.camera))

    def run(self) -> None:
        """Show it until somebody interrupts."""
        last = monotonic()
        while True:
            now = monotonic()
            self.draw(now - last)
            last = now
            busy = self._show.player.playing
            self._show.changed.wait(max(FRAME_S - (monotonic() - now), 0.005) if busy else IDLE_S)

    def draw(self, wall_s: float) -> None:
        """Move on by some time of the wall, and draw what has changed."""
        show = self._show
        show.changed.clear()
        show.player.advance(wall_s, show.timeline.end_s, show.timeline.complete)
        moment = show.timeline.at(max(show.player.time_s, show.timeline.start_s))
        with self._server.atomic():
            self._pose = self._stage.move(moment)
            if self._pose:
                self._stage.sense(moment, self._panel.hidden)
                self._stage.tracks(moment.time_s)
            self._panel.refresh(moment)
            self._deciding.refresh(moment)
        for client in self._server.get_clients().values():
            self._aim(client, self._panel.camera)

    def _aim(self, client: viser.ClientHandle, name: str) -> None:
        """Point a camera at the vehicle, unless people move it themselves."""
        if name == FREE or self._pose is None:
            return
        view = CAMERAS[name](self._pose)
        with client.atomic():
            client.camera.position, client.camera.look_at = view.position_m, view.look_at_m


def _sky() -> NDArray[np.uint8]:
    """Paler towards the ground, shape (n, 1, 3)."""
    ends = np.array([rgb(color) for color in SKY], float)
    share = np.linspace(0.0, 1.0, 128)[:, None, None]
    return ((1.0 - share) * ends[0] + share * ends[1]).astype(np.uint8)


def look(server: viser.ViserServer) -> None:
    """How the scene looks as a whole."""
    server.scene.set_up_direction("+z")
    server.scene.configure_default_lights(cast_shadow=False)
    server.scene.set_background_image(_sky(), format="png")
