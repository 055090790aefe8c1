"""The end of the route: who comes by stands from then on, who misses it turns back."""

import numpy as np
import pytest

from nav.fusion.health import Health
from nav.fusion.obstacle_map import ObstacleMap
from nav.high_level import HighLevelController, Senses
from nav.messages import DirectCommand, EgoEstimate
from nav.parameters import parameters_from
from nav.route.waypoints import Waypoints
from scenarios.parameter_files import parameter_texts

P = parameters_from(parameter_texts())
LENGTH_M = 60.0


def controller() -> HighLevelController:
    end = np.array([[0.0, 0.0], [LENGTH_M, 0.0]])
    return HighLevelController(P, Waypoints(end, np.full(2, 20.0), np.full(2, 5.0)))


def stands(controller: HighLevelController, x_m: float, y_m: float, time_s: float) -> bool:
    ego = EgoEstimate(int(time_s * 1e9), [x_m, y_m], 0.0, 3.0, 0.0, 0.0, 0.0, 0.1, 0.01)
    senses = Senses(ego, 0.0, 0.0, {}, None, Health(), None, 1e3)
    obstacles = ObstacleMap(P.obstacle_map, P.vehicle)
    obstacles.recenter(x_m, y_m)
    command, _ = controller.decide(ego.time_ns, senses, obstacles)
    return isinstance(command, DirectCommand)


def drive(ways: list[tuple[float, float]]) -> list[bool]:
    moving = controller()
    return [stands(moving, *place, 0.1 * k) for k, place in enumerate(ways)]


def test_stands_from_the_end_on():
    assert drive([(50.0, 0.0), (59.5, 1.0), (60.5, 1.0), (66.0, 1.0)]) == [False, False, True, True]


@pytest.mark.parametrize("place", [(60.5, 6.0), (66.0, 1.0)])
def test_who_misses_the_end_has_not_arrived(place):
    assert drive([(52.0, 8.0), place]) == [False, False]
