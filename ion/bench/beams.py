"""The rays of all scanners at one moment, cast by us and by Embree in turn."""

import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from ion.bench.embree import Embree, Singles
from twin.raycast import Scene, cast_hits
from twin.raycast.geometry import Floats, Geometry
from twin.sensors.lidar import Lidar
from twin.sensors.sight import Rays
from twin.simulator import Simulator

PASSES = 10
"""Of all rays, by the one and the other in turn."""


class Scan(NamedTuple):
    """The rays of one scanner, in the form that each of the two takes."""

    rays: Rays
    origins: Singles
    """Shape (n, 3), [m]."""
    directions: Singles
    """Shape (n, 3)."""
    max_range_m: float


class Cost(NamedTuple):
    """Wall time of one ray, [s]."""

    ours_s: float
    embree_s: float | None
    """None without Embree."""


class Duel:
    """Our rays and Embree's among the same things.

    Embree's scene is built again where ours has changed; that takes it a tenth of a second and is
    not counted.
    """

    def __init__(self) -> None:
        self._built: tuple[Geometry, Embree] | None = None

    def cost(self, simulator: Simulator, with_embree: bool) -> Cost:
        """Of a ray of the scanners that the twin has, from where the vehicle is."""
        solid, scans = simulator.sight.solid, scans_of(simulator)
        casters: list[Callable[[Scan], object]] = [lambda scan: ours(solid, scan)]
        if with_embree:
            embree = self._embree(solid.geometry)
            casters.append(lambda scan: theirs(embree, scan))
        spent_s = np.zeros(len(casters))
        for _ in range(PASSES):
            spent_s += [_wall_s(caster, scans) for caster in casters]
        each_s = (spent_s / PASSES / sum(len(scan.origins) for scan in scans)).tolist()
        return Cost(each_s[0], each_s[1] if with_embree else None)

    def _embree(self, geometry: Geometry) -> Embree:
        if self._built is None or self._built[0] is not geometry:
            self._built = geometry, Embree(geometry)
        return self._built[1]


def scans_of(simulator: Simulator) -> list[Scan]:
    """One of each scanner."""
    scanners = [sensor for sensor in simulator.sensors.fitted if isinstance(sensor, Lidar)]
    return [_scan(s.rays(simulator.plant), s.max_range_m) for s in scanners]


def _scan(rays: Rays, max_range_m: float) -> Scan:
    """Each beam has a frame of its own and looks along one axis of it."""
    looks = (rays.rotations @ rays.directions[0]).astype(np.float32)
    return Scan(rays, rays.origins.astype(np.float32), looks, max_range_m)


def ours(scene: Scene, scan: Scan) -> Floats:
    """Ranges (n, 1), [m]."""
    return cast_hits(scene, *scan.rays[:2], scan.max_range_m, scan.rays.rotations)[0]


def theirs(embree: Embree, scan: Scan) -> Singles:
    """Ranges (n,), [m]."""
    return embree.cast(scan.origins, scan.directions, scan.max_range_m)


def _wall_s(cast: Callable[[Scan], object], scans: Sequence[Scan]) -> float:
    start_s = time.perf_counter()
    for scan in scans:
        cast(scan)
    return time.perf_counter() - start_s
