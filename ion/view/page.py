"""The page: a scene, a panel beside it, and the loop that moves both on."""

from pathlib import Path
from time import monotonic

import numpy as np
import viser
from numpy.typing import NDArray

from ion.view.cameras import CAMERAS, FREE
from ion.view.course_scene import draw_course, draw_gates
from ion.view.decide.deciding import Deciding
from ion.view.panel import Panel
from ion.view.places import Places, Pose
from ion.view.sensor_scene import SensorScene
from ion.view.shapes import rgb
from ion.view.show import Show
from ion.view.vehicle_scene import VehicleScene
from nav.parameters import parameters_from
from scenarios.vehicles import VEHICLES

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
        self._course = course = show.recorded.course()
        parameters = parameters_from(show.recorded.files, course.vehicle)
        self._places = Places(course)
        self._pose: Pose | None = None
        self._gates: set[int] | None = None
        look(server)
        draw_course(server.scene, course, self._places)
        height_m = VEHICLES[course.vehicle].height_m
        self._vehicle = VehicleScene(server.scene, course.vehicle, parameters.vehicle, height_m)
        self._sensors = SensorScene(server.scene, self._places, parameters)
        self._panel = Panel(server.gui, self._show, f"{course.name}, seed {show.recorded.seed}")
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
        pose = self._places.vehicle(moment)
        with self._server.atomic():
            if pose:
                self._vehicle.show(moment, pose)
                self._sensors.show(show.timeline, moment, self._panel.hidden)
            self._draw_gates(moment.time_s)
            self._panel.refresh(moment)
            self._deciding.refresh(moment)
        self._pose = pose
        for client in self._server.get_clients().values():
            self._aim(client, self._panel.camera)

    def _aim(self, client: viser.ClientHandle, name: str) -> None:
        """Point a camera at the vehicle, unless people move it themselves."""
        if name == FREE or self._pose is None:
            return
        view = CAMERAS[name](self._pose)
        with client.atomic():
            client.camera.position, client.camera.look_at = view.position_m, view.look_at_m

    def _draw_gates(self, time_s: float) -> None:
        """Anew only when one was passed or missed."""
        found = {"gate": set[int](), "missed": set[int]()}
        for event in self._show.recorded.events:
            if event.kind in found and event.time_s <= time_s:
                found[event.kind].add(int(event.text.split()[-1]) - 1)
        if self._gates != found["gate"] | found["missed"]:
            self._gates = found["gate"] | found["missed"]
            draw_gates(self._server.scene, self._course, self._places, *found.values())


def _sky() -> NDArray[np.uint8]:
    """Paler towards the ground, shape (n, 1, 3)."""
    ends = np.array([rgb(color) for color in SKY], float)
    share = np.linspace(0.0, 1.0, 128)[:, None, None]
    return ((1.0 - share) * ends[0] + share * ends[1]).astype(np.uint8)


def look(server: viser.ViserServer) -> None:
    """How the page looks as a whole."""
    server.gui.configure_theme(control_width="large", show_logo=False, show_share_button=False)
    server.gui.main_panel.dock_right()
    server.scene.set_up_direction("+z")
    server.scene.configure_default_lights(cast_shadow=False)
    server.scene.set_background_image(_sky(), format="png")
