"""The image-processing module: where the road lies, and how sure it is of that."""

from math import atan2

import numpy as np

from nav.messages import RoadEstimate
from twin.sensors.parameters import RoadCameraParameters
from twin.sensors.sensor import Floats, View, generator, schedule
from twin.world import Road


class RoadCamera:
    """Tells of a world's road. Where the road cannot be seen, it guesses and says so."""

    name = "road_camera"

    def __init__(self, road: Road, seed: int, p: RoadCameraParameters) -> None:
        self.schedule = schedule(p)
        self._p, self._road = p, road
        self._rng = generator(seed, self.name)
        self._line = np.array(road.line_m)

    def measure(self, view: View, time_ns: int) -> RoadEstimate:
        """The estimate of this instant."""
        position, rotation = view.site_pose("reference")
        forward = rotation[:, 0]
        station, offset, road = self._beside(float(position[0]), float(position[1]))
        noise = self._rng.standard_normal(4)
        turn = (
            road - atan2(float(forward[1]), float(forward[0])) + self._p.heading_sd_rad * noise[1]
        )
        hidden = any(a <= station <= b for a, b in self._road.unseen_m)
        seen = not (hidden or self._dazzled(forward))
        blur = 1.0 if seen else self._p.blind_factor
        confidence = (self._p.confidence if seen else self._p.blind_confidence) + 0.03 * noise[3]
        return RoadEstimate(
            time_ns,
            offset_m=offset + blur * self._p.offset_sd_m * float(noise[0]),
            heading_rad=float((turn + np.pi) % (2.0 * np.pi) - np.pi),
            width_m=self._road.width_m + self._p.width_sd_m * float(noise[2]),
            confidence=float(np.clip(confidence, 0.0, 1.0)),
        )

    def _dazzled(self, forward: Floats) -> bool:
        """Whether it looks towards a low sun."""
        if self._road.sun_rad is None or self._road.sun_rad[1] > self._p.glare_elevation_rad:
            return False
        off = atan2(float(forward[1]), float(forward[0])) - self._road.sun_rad[0]
        return abs((off + np.pi) % (2.0 * np.pi) - np.pi) < self._p.glare_rad

    def _beside(self, x: float, y: float) -> tuple[float, float, float]:
        """Station, offset to the left, and direction of the nearest piece of the road."""
        start, step = self._line[:-1], np.diff(self._line, axis=0)
        length = np.hypot(step[:, 0], step[:, 1])
        d = np.array([x, y]) - start
        along = np.clip((d * step).sum(axis=1) / length**2, 0.0, 1.0)
        gap = d - along[:, None] * step
        k = int(np.argmin(np.hypot(gap[:, 0], gap[:, 1])))
        station = float(length[:k].sum() + along[k] * length[k])
        left = (step[k, 0] * d[k, 1] - step[k, 1] * d[k, 0]) / length[k]
        return station, float(left), atan2(float(step[k, 1]), float(step[k, 0]))
