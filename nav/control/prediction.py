"""Where the vehicle will be when a steering target of now takes effect.

Targets that are under way already are remembered, and the steering's rate is known, so the motion
until then is known too.
"""

from collections import deque
from dataclasses import dataclass, field
from math import cos, sin
from typing import NamedTuple

from nav.messages import EgoEstimate
from nav.parameters.vehicle import Steering
from nav.steering_circle import curvature

STRIDE = 3
"""Ticks in one step of the prediction: 60 ms, in which the steering moves by one degree."""


class Prediction(NamedTuple):
    """Pose (route frame N) and curvature at that time."""

    x_m: float
    y_m: float
    heading_rad: float
    curvature_per_m: float


@dataclass
class Predictor:
    """Remembers the targets of the last `delay_s`."""

    steering: Steering
    tick_s: float
    targets: deque[float] = field(init=False)

    def __post_init__(self) -> None:
        count = round(self.steering.delay_s / self.tick_s)
        self.targets = deque([0.0] * count, maxlen=count)

    def sent(self, steering_rad: float) -> None:
        """A target has left."""
        self.targets.append(steering_rad)

    def predict(self, ego: EgoEstimate, steering_rad: float) -> Prediction:
        """Let the measured road-wheel angle follow the targets under way."""
        x, y = ego.position_m.tolist()
        stride_s = STRIDE * self.tick_s
        heading, step = ego.heading_rad, ego.speed_mps * stride_s
        most, angle = self.steering.rate_radps * stride_s, steering_rad
        for target in list(self.targets)[STRIDE - 1 :: STRIDE]:
            angle += min(max(target - angle, -most), most)
            turn = step * curvature(angle, self.steering)
            x += step * cos(heading + 0.5 * turn)
            y += step * sin(heading + 0.5 * turn)
            heading += turn
        return Prediction(x, y, heading, curvature(angle, self.steering))
