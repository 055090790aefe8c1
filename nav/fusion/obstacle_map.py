"""The local grid map that moves with the vehicle: where obstacles stand, and how sure that is.

A cell gains confidence from returns above the ground profile. It loses confidence only in view:
quickly where a beam passes through it no higher than its known top, slowly where a beam ends at
its distance but not in it (a wall seen from a pose that has drifted since). What no beam reaches
keeps its confidence, so blind corners persist, and so does what is lower than the level beams.
Returns near a track of the radar gain more (`radar`), and echoes of sonars gain by themselves.
Drops enter the same cells (`negative_obstacles`), and lose where steep beams meet ground. They
alone are remembered when the map moves on (`remembered_drops`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nav.errors import NavError
from nav.fusion.expected_ground import Bools, Expected, expected
from nav.fusion.ground_profile import GroundProfile
from nav.fusion.lattice import Ints, Lattice
from nav.fusion.negative_obstacles import NOTHING, drops
from nav.fusion.radar import Echoes
from nav.fusion.remembered_drops import NO_DROPS, Drops
from nav.fusion.scan_geometry import (
    Pose,
    ScanGeometry,
    Scans,
    Sweep,
    placed,
    scan_geometry,
)
from nav.fusion.see_through import look
from nav.fusion.sorting import sorted_returns
from nav.fusion.vehicle_places import footprint, sonar_arcs, turned, wheels
from nav.messages import Floats
from nav.parameters.obstacle_map import ObstacleMapParameters
from nav.parameters.vehicle import VehicleParameters

_NO_TOP_M = -1e6
_TOP_SHARE = 0.5
"""By which a cell's top moves to the highest return of a tick."""
_NOWHERE = np.zeros(0, np.int64)
_LONGEST_S = 0.3
"""Decay of one tick covers at most this time: one look after a gap proves no long absence."""


@dataclass(frozen=True, eq=False)
class Occupied:
    """The cells that are obstacles."""

    index: Ints
    """Shape (n,), flat: row (north) * count + column (east)."""
    position_m: Floats
    """Shape (n, 2), cell centres, route frame N."""
    confidence: Floats
    """Shape (n,), 0 to 1."""


class ObstacleMap:
    """Confidence and top height of the cells around the vehicle.

    Args:
        parameters: `obstacle_map.toml`.
        vehicle: mounts of the scanners and sonars, and the outline, which is never occupied.
    """

    def __init__(self, parameters: ObstacleMapParameters, vehicle: VehicleParameters) -> None:
        self.parameters = parameters
        self.lattice = Lattice(parameters.cell_m, round(parameters.size_m / parameters.cell_m))
        self.ground = GroundProfile(parameters.ground, parameters.size_m, wheels(vehicle))
        shape = (self.lattice.count, self.lattice.count)
        self._confidence = np.zeros(shape, np.float32)
        self._top = np.full(shape, _NO_TOP_M, np.float32)  # above the ground profile's datum
        self._held = np.zeros(0, np.int64)
        """Flat indices, ascending, of the cells that hold confidence, and some more: a hundredth
        of all, so that nobody need look through the whole map."""
        self._gain = np.zeros(shape, np.float32)  # of this tick; zero between ticks
        self._highest = np.full(shape, _NO_TOP_M)  # return of this tick; no top between ticks
        self.geometry = {
            name: scan_geometry(mount, vehicle.lidar, vehicle.outline)
            for name, mount in vehicle.lidar_mounts.items()
        }
        self._teachers = self._looking_down(())
        """Mounted to look at the ground ahead: only such scanners teach it. The others meet ground
        when the vehicle rolls, far away and with errors of their own."""
        self._negative = parameters.negative
        self._shown = np.zeros(shape[0] * shape[1], bool)
        """Cells in which beams show a drop; all False between ticks."""
        self._drops = NO_DROPS
        """Outside the map."""
        self._hit = parameters.confidence.hit
        self._sonar_arcs = sonar_arcs(vehicle)
        self._sonar_min_m = vehicle.sonar.min_range_m
        self._footprint = footprint(vehicle.outline, parameters.cell_m)
        self.returns_m: Floats = np.zeros((3, 0))
        """Where the returns of obstacles ended in the last tick, shape (3, n): east, north, height
        above the reference point. For those who look on."""
        self._bare = _NOWHERE
        """Cells in which a steep beam has met ground in this tick."""
        self._time_ns: int | None = None
        self._placed = False

    # ------------------------------------------------------------------ what it holds

    @property
    def grid(self) -> NDArray[np.float32]:
        """Confidence, shape (count, count), row north, column east. Not a copy."""
        return self._confidence

    @property
    def cell_m(self) -> float:
        """Edge of a cell, [m]."""
        return self.lattice.cell_m

    @property
    def origin_m(self) -> tuple[float, float]:
        """South-west corner of cell (0, 0), route frame N, [m]."""
        return self.lattice.origin_m

    def occupied_index(self) -> Ints:
        """Where the cells are whose confidence makes them obstacles, flat, shape (n,)."""
        confidence = self._confidence.ravel()[self._held]
        return self._held[confidence >= self.parameters.confidence.occupied]

    def occupied(self) -> Occupied:
        """All cells whose confidence makes them obstacles."""
        cells, index = self._confidence.ravel(), self.occupied_index()
        return Occupied(
            index, np.stack(self.lattice.centre_m(index), axis=1), cells[index].astype(np.float64)
        )

    # ------------------------------------------------------------------ what comes in

    def weigh(self, lost: Sequence[str]) -> None:
        """With scanners lost, the returns of those that are left count for more (section 6.3)."""
        gone = len([name for name in lost if name in self.geometry])
        share = len(self.geometry) / max(len(self.geometry) - gone, 1)
        self._hit = self.parameters.confidence.hit * share
        self._teachers = self._looking_down(lost)

    def _looking_down(self, lost: Sequence[str]) -> list[str]:
        """The scanners that look at the ground ahead; without them, those that look there less."""
        p = self.parameters.ground
        fall = {n: -g.mount[2, 0] for n, g in self.geometry.items() if n not in lost}
        steep = [name for name in fall if fall[name] > p.teaching_slope]
        return steep or [name for name in fall if fall[name] > p.spare_slope]

    def recenter(self, x_m: float, y_m: float) -> None:
        """Move the map by whole cells, once (x_m, y_m) is `scroll_m` away from its middle."""
        if self._placed and self.lattice.offset_m(x_m, y_m) <= self.parameters.scroll_m:
            return
        self._placed = True
        to, drops = self.lattice.centred(x_m, y_m), self._drops.with_more(self._held_drops())
        self._confidence = self.lattice.moved(self._confidence, to, 0.0)
        self._top = self.lattice.moved(self._top, to, _NO_TOP_M)
        self.lattice = to
        self._restore(drops)
        self._drops = drops.outside(to, self._negative.remember_m)
        self._held = np.flatnonzero(self._confidence > 0.0)
        self.ground.recentre(x_m, y_m)

    def _held_drops(self) -> Drops:
        """The drops that the map holds: confidence without a top."""
        tops, cells = self._top.ravel(), self._confidence.ravel()
        index = self._held[(tops[self._held] == _NO_TOP_M) & (cells[self._held] > 0.0)]
        return Drops(np.stack(self.lattice.centre_m(index)), cells[index])

    def _restore(self, drops: Drops) -> None:
        """Let drops be in the map; in those that never left it, nothing changes."""
        index, inside = self._cells(drops.position_m)
        cells = self._confidence.ravel()
        cells[index] = np.maximum(cells[index], drops.confidence[inside])

    def integrate(self, sweeps: Sequence[Sweep], echoes: Echoes | None = None) -> None:
        """Take in the scans of one tick, oldest first, each with the estimate at its time; and
        what the radar tells meanwhile, if it does.

        Raises:
            NavError: a scan of a scanner that the vehicle does not have.
        """
        chosen = self._newest(sweeps)
        if not chosen:
            self.returns_m = np.zeros((3, 0))
            return
        time_ns, pose = chosen[-1].scan.time_ns, chosen[-1].pose
        self._follow(pose)
        chosen.sort(key=lambda sweep: sweep.scan.sensor not in self._teachers)
        views = self._views(chosen)
        sensors = [sweep.scan.sensor for sweep in chosen]
        steep = [sensor for sensor in sensors if sensor in self._teachers]
        expect = expected(self.ground, self._negative) if self._negative.enabled and steep else None
        lower = drops(views.only(list(range(len(steep)))), expect, pose) if expect else NOTHING
        hits, points = self._mark(views, len(steep), pose, expect)
        self.returns_m = points
        self._gather(hits, points, echoes)
        newest = {sensor: k for k, sensor in enumerate(sensors)}
        self._decay(views.only(list(newest.values())), self._elapsed_s(time_ns))
        self._add(hits)
        self._mark_drops(lower)
        self._clear_footprint(pose)

    def integrate_sonar(self, range_m: Floats, pose: Pose) -> None:
        """Mark the arcs of one round of sonars, shape (n,), [m], at modest confidence."""
        p = self.parameters
        heard = (range_m >= self._sonar_min_m) & (range_m <= p.sonar_range_m)
        if not heard.any():
            return
        self._follow(pose, new_bound=False)
        origin, arc = (a[heard] for a in self._sonar_arcs)
        place = (origin + arc * range_m[heard, None, None]).reshape(-1, 3)
        index, inside = self._cells(turned(place.T, pose))
        index, first = np.unique(index, return_index=True)
        cells = self._confidence.ravel()
        self._held = _merged(self._held, index)
        lifted = np.minimum(cells[index] + p.confidence.sonar, p.confidence.sonar_limit)
        cells[index] = np.maximum(cells[index], lifted)
        top = self.ground.vehicle_m + place[inside, 2][first]
        self._top.ravel()[index] = np.maximum(self._top.ravel()[index], top)
        self._clear_footprint(pose)

    def _newest(self, sweeps: Sequence[Sweep]) -> list[Sweep]:
        left = dict.fromkeys(self.geometry, self.parameters.scans_per_sensor)
        chosen: list[Sweep] = []
        for sweep in reversed(sweeps):
            name = sweep.scan.sensor
            if name not in left:
                raise NavError(f"no LIDAR is named {name!r}; known are {', '.join(left)}")
            if left[name] > 0:
                chosen.append(sweep)
            left[name] -= 1
        return chosen[::-1]

    def _views(self, sweeps: Sequence[Sweep]) -> Scans:
        geometry = [self.geometry[sweep.scan.sensor] for sweep in sweeps]
        frame = _placed(geometry, [sweep.pose for sweep in sweeps])
        range_m = np.array([sweep.scan.range_m for sweep in sweeps])
        began = [sweep.began for sweep in sweeps if sweep.began]
        moved = frame - _placed(geometry, began) if len(began) == len(sweeps) else None
        return Scans(geometry, frame, range_m, moved)

    def _follow(self, pose: Pose, new_bound: bool = True) -> None:
        self.recenter(pose.x_m, pose.y_m)
        if new_bound:
            self.ground.drive(pose)

    def _elapsed_s(self, time_ns: int) -> float:
        last = time_ns if self._time_ns is None else self._time_ns
        self._time_ns = time_ns
        return min(max((time_ns - last) * 1e-9, 0.0), _LONGEST_S)

    # ------------------------------------------------------------------ returns

    def _mark(
        self, scans: Scans, steep: int, pose: Pose, expect: Expected | None
    ) -> tuple[Ints, Floats]:
        """Sort the returns; those of obstacles: their cells (n,) and their places (3, n)."""
        obstacle_m, bare_m = sorted_returns(
            self.ground, self.parameters, scans, steep, pose, expect
        )
        self._bare = self._cells(bare_m)[0]
        index, inside = self._cells(obstacle_m)
        return index, obstacle_m[:, inside]

    def _cells(self, place_m: Floats) -> tuple[Ints, Bools]:
        """The cells of those places (2 or 3, n) that lie in the map, and which do."""
        index, inside = self.lattice.index(place_m[0], place_m[1])
        return index[inside], inside

    def _gather(self, index: Ints, points: Floats, echoes: Echoes | None) -> None:
        """Let the cells of returns gain in `_gain` and `_top`."""
        gain = np.full(len(index), self._hit, np.float32)
        if echoes:
            gain[echoes.near(points[:2])] *= self.parameters.confidence.radar
        np.add.at(self._gain.ravel(), index, gain)
        self._raise(index, points[2] + self.ground.vehicle_m)

    def _raise(self, index: Ints, height_m: Floats) -> None:
        """Let the tops of cells follow the highest return of a tick, above the datum.

        The highest of all would not do: one level beam that dips onto a bale far away, half a
        degree off, seems to have met something tall, and the next beams just over it deny it all.
        """
        tops, highest = self._top.ravel(), self._highest.ravel()
        np.maximum.at(highest, index, height_m)
        old = tops[index]
        share = np.where(old > _NO_TOP_M, _TOP_SHARE, 1.0)
        tops[index] = old + share * (highest[index] - old)
        highest[index] = _NO_TOP_M

    def _mark_drops(self, place_m: Floats) -> None:
        """Cells where drops are shown gain, and so do their neighbours.

        A drop has no top, so that no level beam denies it."""
        index = self._cells(place_m)[0]
        if index.size:
            count, last = self.lattice.count, self._shown.size - 1
            for beside in (0, 1, -1, count, -count):
                self._shown[np.minimum(np.maximum(index + beside, 0), last)] = True
            cells = np.flatnonzero(self._shown)
            self._shown[cells] = False
            self._gain.ravel()[cells] = self._negative.gain
            self._add(cells)

    def _add(self, index: Ints) -> None:
        cells, gain = self._confidence.ravel(), self._gain.ravel()
        most = 2 * self._hit
        cells[index] = np.minimum(cells[index] + np.minimum(gain[index], most), 1.0)
        gain[index] = 0.0
        self._held = _merged(self._held, index)

    def _clear_footprint(self, pose: Pose) -> None:
        under = self._cells(turned(self._footprint, pose))[0]
        self._confidence.ravel()[under] = 0.0
        self._top.ravel()[under] = _NO_TOP_M

    def _decay(self, scans: Scans, elapsed_s: float) -> None:
        """Take confidence from cells in view that were not hit in this tick."""
        cells = self._confidence.ravel()
        self._held = self._held[cells[self._held] > 0.0]
        index = self._held[self._gain.ravel()[self._held] == 0.0]
        if not index.size:
            return
        x, y = self.lattice.centre_m(index)
        top = self._top.ravel()[index].astype(np.float64)
        place = np.array([x, y, top - self.ground.vehicle_m])
        p = self.parameters.confidence
        through, beside = look(scans, place, p.margin_m, p.low_m)
        bare = np.zeros(cells.size, bool)
        bare[self._bare] = True
        rate = np.where(through | bare[index], p.clear_ps, np.where(beside, p.fade_ps, 0.0))
        loss = rate * elapsed_s
        drop = self._top.ravel()[index] == _NO_TOP_M
        loss[drop & bare[index]] = self._negative.clear
        left = np.maximum(cells[index] - loss, 0.0)
        cells[index] = left
        self._top.ravel()[index[left == 0.0]] = _NO_TOP_M


def _placed(geometry: Sequence[ScanGeometry], poses: Sequence[Pose]) -> Floats:
    """Scanners in the level frame, shape (k, 3, 3)."""
    return np.array([placed(*each) for each in zip(geometry, poses, strict=True)])


def _merged(held: Ints, more: Ints) -> Ints:
    """Both, ascending and each once; np.union1d takes four times as long."""
    both = np.concatenate([held, more])
    both.sort()
    first = np.ones(both.size, bool)
    np.not_equal(both[1:], both[:-1], out=first[1:])
    return both[first]
