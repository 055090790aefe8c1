"""Digital compass: heading with an error that stays, one that does not, and one from steel."""

import numpy as np

from nav.messages import CompassHeading
from twin.sensors.iron import Iron
from twin.sensors.parameters import CompassParameters
from twin.sensors.sensor import Floats, View, generator, schedule
from twin.sensors.sight import Sight


class Compass:
    """The bias stands for what calibration and the vehicle's own iron leave."""

    name = "compass"

    def __init__(self, seed: int, p: CompassParameters, sight: Sight | None = None) -> None:
        """Without a `sight` there is no steel beside the track."""
        self.schedule = schedule(p)
        self._p = p
        self._rng = generator(seed, self.name)
        self._sight, self._iron = sight, Iron((), p)
        self._bias_rad = p.bias_sd_rad * self._rng.standard_normal()

    def measure(self, view: View, time_ns: int) -> CompassHeading:
        """The heading of this instant."""
        position, rotation = view.site_pose(self.name)
        forward = rotation[:, 0]
        error = self._bias_rad + self._p.noise_sd_rad * self._rng.standard_normal()
        error -= self._turn_rad(position)
        heading = np.arctan2(forward[1], forward[0]) + error
        return CompassHeading(time_ns, float(np.pi - (np.pi - heading) % (2.0 * np.pi)))

    def _turn_rad(self, position: Floats) -> float:
        if self._sight and self._iron.things is not self._sight.things:
            self._iron = Iron(self._sight.things, self._p)
        return self._iron.turn_rad(position)
