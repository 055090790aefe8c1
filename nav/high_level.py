"""The high-level controller (10 Hz): from fused state to a local path and a speed set point."""

from dataclasses import dataclass
from math import atan2, hypot

import numpy as np

from nav.angles import wrapped
from nav.fusion.health import Health
from nav.fusion.lattice import Ints
from nav.fusion.obstacle_map import ObstacleMap
from nav.messages import (
    Command,
    Decision,
    EgoEstimate,
    Floats,
    Gear,
    RoadEstimate,
    VehicleState,
)
from nav.parameters import Parameters
from nav.planning.boundaries import FREE, Cells, boundaries
from nav.planning.corridor_grid import CorridorGrid
from nav.planning.curve import Curve
from nav.planning.local_path import clear_distances, join_length, route_ahead
from nav.planning.scanning import Boundaries
from nav.planning.speed_profile import speed_profile
from nav.planning.wide_grid import WideGrid
from nav.route.smooth_path import Projection, SmoothPath, project, smooth_path
from nav.route.waypoints import Waypoints
from nav.states.machine import Machine
from nav.states.situation import Plan, Situation, stand
from nav.steering_circle import curvature_rate

CORRIDOR_BEHIND = 2
"""The corridor is drawn from this many segments behind the present one ..."""
CORRIDOR_AHEAD_M = 45.0
"""... to this far ahead of it."""
WIDE_BEHIND, WIDE_M = 6, 60.0
"""The same on the wide grid, on which a way around is looked for."""


@dataclass(frozen=True)
class Senses:
    """What the fusion modules say at this moment."""

    ego: EgoEstimate
    curvature_per_m: float
    gps_lost_s: float
    sonar_m: dict[str, float]
    vehicle: VehicleState | None
    """The newest word of the drive-by-wire unit."""
    health: Health
    road: RoadEstimate | None
    """If it is fresh."""
    confirmed_m: float
    """Distance ahead that two sensors confirm to be occupied."""


class HighLevelController:
    """Knows the route, draws the corridor, and asks the state machine for a plan."""

    def __init__(self, parameters: Parameters, waypoints: Waypoints) -> None:
        self.parameters = parameters
        self.waypoints = waypoints
        self._corridor_grid = _corridor_grid(waypoints, parameters)
        self._wide_corridor = _corridor_grid(waypoints, parameters)
        self.route: SmoothPath = smooth_path(waypoints)
        self.V0: Floats = speed_profile(
            self.route, waypoints.half_width_m[self.route.segment], parameters.planning.speed
        )
        self.machine = Machine(parameters)
        self.here = Projection(0, 0.0, 0.0)
        self._arrived = False
        self.situation: Situation | None = None
        """What the last decision saw ..."""
        self.plan: Plan | None = None
        """... and what it came to: for who asks why."""
        self._corridor: tuple[tuple[object, ...], Cells] | None = None
        self._obstacles: tuple[Ints, Cells] | None = None
        self._grid: WideGrid | None = None
        """What was seen since the trouble began."""

    def retune(self, parameters: Parameters) -> None:
        """Decide by other fuzzy rules and states from now on: nothing here is made from them."""
        self.parameters = self.machine.parameters = parameters

    def decide(
        self, time_ns: int, senses: Senses, obstacles: ObstacleMap
    ) -> tuple[Command, Decision]:
        """One decision: the command for the low-level controller, and the numbers behind it."""
        self.here = project(self.route, senses.ego.position_m, self.here.index)
        s = self._situation(time_ns, senses, obstacles)
        plan = self.machine.decide(s)
        self._arrived = self._arrived or self._arrives(senses.ego)
        if self._arrived:
            plan = stand(s)
        self.situation, self.plan = s, plan
        return plan.command, self._decision(s, plan)

    def _arrives(self, ego: EgoEstimate) -> bool:
        """Just behind the end of the route; who comes by far beside it has to turn back."""
        x, y = (ego.position_m - self.route.position_m[-1]).tolist()
        near = hypot(x, y) <= self.parameters.planning.local_path.arrival_m
        return near and self.here.arc_m >= self.route.arc_m[-1]

    def _situation(self, time_ns: int, senses: Senses, obstacles: ObstacleMap) -> Situation:
        p, ego, here = self.parameters.planning, senses.ego, self.here
        boundaries = self._boundaries(obstacles)
        troubled = self.machine.memory.trouble.arc_m is not None
        self._grid = self._grid if troubled else None
        turned = wrapped(ego.heading_rad - float(self.route.heading_rad[here.index]))
        ahead = self._route_ahead(ego, turned)
        return Situation(
            time_ns=time_ns,
            ego=ego,
            boundaries=boundaries,
            route_ahead=ahead,
            route_clear=clear_distances(ahead, boundaries, p.footprint),
            goal_rad=self._goal(ego),
            V0_mps=self._limit(senses.health),
            cross_track_m=here.cross_track_m,
            waypoint=self._segment + 1,
            curvature_per_m=senses.curvature_per_m,
            gps_lost_s=senses.gps_lost_s,
            sonar_m=senses.sonar_m,
            arc_m=here.arc_m,
            far_goal_m=self._far_goal(boundaries) if troubled else (0.0, 0.0),
            turned_rad=turned,
            half_width_m=float(self.waypoints.half_width_m[self._segment]),
            narrowest_m=self._narrowest(p.speed.settle_ahead_m),
            gear=senses.vehicle.gear if senses.vehicle else Gear.HIGH,
            shifting=bool(senses.vehicle and senses.vehicle.shifting),
            health=senses.health,
            road=senses.road,
            confirmed_m=senses.confirmed_m,
            edges=self._edges(obstacles),
            wide=self._wide(ego, boundaries) if troubled else None,
        )

    @property
    def _segment(self) -> int:
        return int(self.route.segment[self.here.index])

    def _limit(self, health: Health) -> float:
        """The speed limit in force: lower with a sensor lost (section 6.3)."""
        V0 = float(self.V0[self.here.index])
        return min(V0, self.parameters.states.alarm.lost_mps) if health.lost else V0

    def _route_ahead(self, ego: EgoEstimate, turned: float) -> Curve:
        here, rate = self.here, curvature_rate(self.parameters.vehicle.steering)
        local = self.parameters.planning.local_path
        join_m = join_length(here.cross_track_m, ego.speed_mps, rate, local)
        return route_ahead(
            self.route, here.index, here.cross_track_m, turned, join_m, local.look_ahead_m
        )

    def _goal(self, ego: EgoEstimate) -> float:
        """phi(k): towards a point of the smooth path some seconds ahead."""
        p = self.parameters.planning.local_path
        reach = max(p.goal_min_m, p.goal_s * ego.speed_mps)
        i = int(self.route.arc_m.searchsorted(self.here.arc_m + reach))
        x, y = self.route.position_m[min(i, len(self.route.arc_m) - 1)] - ego.position_m
        return atan2(float(y), float(x))

    def _far_goal(self, boundaries: Boundaries) -> tuple[float, float]:
        """The farthest point of the smooth path on the wide grid that is outside all boundaries;
        beyond the map all is free."""
        end = int(self.route.arc_m.searchsorted(self.here.arc_m + WIDE_M))
        here = self.here.index  # beyond `end` when the vehicle is far behind its nearest place
        places = self.route.position_m[here : max(end, here) + 1]
        free = boundaries.at(places[:, 0], places[:, 1]) == FREE
        x, y = places[free][-1] if free.any() else places[-1]
        return float(x), float(y)

    def _boundaries(self, obstacles: ObstacleMap) -> Boundaries:
        level = np.maximum(self._obstacle_level(obstacles), self._corridor_level(obstacles))
        return Boundaries(level, obstacles.origin_m, obstacles.cell_m)

    def _edges(self, obstacles: ObstacleMap) -> Boundaries:
        return Boundaries(self._corridor_level(obstacles), obstacles.origin_m, obstacles.cell_m)

    def _obstacle_level(self, obstacles: ObstacleMap) -> Cells:
        """The boundaries of obstacles; expanded anew when an obstacle has come or gone."""
        occupied = obstacles.occupied_index()
        if self._obstacles is None or not np.array_equal(self._obstacles[0], occupied):
            foot, lattice = self.parameters.planning.footprint, obstacles.lattice
            radius_m = (foot.safe_radius_m, foot.real_radius_m, foot.touch_radius_m)
            expanded = boundaries(occupied, lattice.count, lattice.cell_m, radius_m)
            self._obstacles = (occupied, expanded)
        return self._obstacles[1]

    def _corridor_level(self, obstacles: ObstacleMap) -> Cells:
        """The boundaries of the corridor's edge; drawn anew when map or segment have moved."""
        first, last = self._corridor_segments(CORRIDOR_BEHIND, CORRIDOR_AHEAD_M)
        key = (obstacles.origin_m, first, last)
        if self._corridor is None or self._corridor[0] != key:
            edges = self._corridor_grid.levels(obstacles.lattice, first, last)
            self._corridor = (key, edges)
        return self._corridor[1]

    def _wide(self, ego: EgoEstimate, boundaries: Boundaries) -> Boundaries:
        """The corridor and what is known in it, twice as wide as the map."""
        self._grid = grid = self._grid or WideGrid(boundaries.cell_m)
        grid.update(boundaries, *ego.position_m.tolist())
        segments = self._corridor_segments(WIDE_BEHIND, WIDE_M)
        return grid.with_edges(self._wide_corridor.levels(grid.lattice, *segments))

    def _corridor_segments(self, behind: int, ahead_m: float) -> tuple[int, int]:
        """The first segment that is drawn, and the one after the last."""
        segment = self._segment
        end = int(self.route.arc_m.searchsorted(self.here.arc_m + ahead_m))
        finish = end >= len(self.route.arc_m)
        last = int(self.route.segment[-1]) + 2 if finish else int(self.route.segment[end]) + 1
        return max(0, segment - behind), last

    def _narrowest(self, ahead_m: float) -> float:
        """The least half-width of the corridor from here on."""
        first, last = self._corridor_segments(0, ahead_m)
        return float(self.waypoints.half_width_m[first:last].min())

    def _decision(self, s: Situation, plan: Plan) -> Decision:
        return Decision(
            time_ns=s.time_ns,
            state=self.machine.state,
            reason=self.machine.reason,
            replanned=plan.replanned,
            waypoint=s.waypoint,
            goal_rad=s.goal_rad,
            decision_rad=plan.decision_rad,
            selected=plan.selected,
            D1_m=plan.D1_m,
            D_m=plan.D_m,
            V0_mps=s.V0_mps,
            speed_mps=plan.speed_mps,
            cross_track_m=s.cross_track_m,
        )


def _corridor_grid(waypoints: Waypoints, parameters: Parameters) -> CorridorGrid:
    foot = parameters.planning.footprint
    margin_m = (foot.corridor_safe_m, foot.corridor_real_m, foot.corridor_touch_m)
    return CorridorGrid(_with_run_out(waypoints.position_m), waypoints.half_width_m, margin_m)


def _with_run_out(position_m: Floats) -> Floats:
    """Waypoints (n, 2) and one more, straight on: the finish is no wall, one drives through it."""
    last = position_m[-1] - position_m[-2]
    ahead = last / np.hypot(last[0], last[1]) * CORRIDOR_AHEAD_M
    return np.vstack([position_m, position_m[-1] + ahead])
