"""All of a drive that one sees in three dimensions, at one moment."""

from collections.abc import Set as AbstractSet

import viser

from ion.view.canvas import Precision
from ion.view.course_scene import draw_course, draw_gates
from ion.view.places import Places, Pose
from ion.view.sensor_scene import SensorScene
from ion.view.show import Show
from ion.view.timeline import Moment
from ion.view.vehicle_scene import VehicleScene
from nav.parameters import parameters_from
from scenarios.vehicles import VEHICLES


class Stage:
    """Drawn into a scene: what stands still at once, the rest when it is shown.

    Args:
        scene: drawn in.
        show: what is shown.
        precision: of points.

    Raises:
        TapeError: the course that was driven is not known here.
    """

    def __init__(self, scene: viser.SceneApi, show: Show, precision: Precision = "float32") -> None:
        self._scene, self._show = scene, show
        self.course = course = show.recorded.course()
        parameters = parameters_from(show.recorded.files, course.vehicle)
        self._places = Places(course)
        draw_course(scene, course, self._places)
        height_m = VEHICLES[course.vehicle].height_m
        self._vehicle = VehicleScene(scene, course.vehicle, parameters.vehicle, height_m)
        self._sensors = SensorScene(scene, self._places, parameters, precision)
        self._gates: set[int] | None = None

    def move(self, moment: Moment) -> Pose | None:
        """Put the vehicle where it is, and colour the gates; the pose, if it is known."""
        pose = self._places.vehicle(moment)
        if pose:
            self._vehicle.show(moment, pose)
        self._draw_gates(moment.time_s)
        return pose

    def sense(self, moment: Moment, hidden: AbstractSet[str] = frozenset()) -> None:
        """What the sensors see, and what the navigator makes of it."""
        self._sensors.show(self._show.timeline, moment, hidden)

    def tracks(self, time_s: float) -> None:
        """The trajectory up to a time."""
        self._sensors.tracks(self._show.timeline, time_s)

    def _draw_gates(self, time_s: float) -> None:
        """Anew only when one was passed or missed."""
        found = {"gate": set[int](), "missed": set[int]()}
        for event in self._show.recorded.events:
            if event.kind in found and event.time_s <= time_s:
                found[event.kind].add(int(event.text.split()[-1]) - 1)
        if self._gates != found["gate"] | found["missed"]:
            self._gates = found["gate"] | found["missed"]
            draw_gates(self._scene, self.course, self._places, *found.values())
