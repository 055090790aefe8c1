"""What two sensors agree is close ahead: the raw ranges, without the map.

The guarded watchdog drives over cells of the map, but never into this. A scanner confirms where
neighbouring beams all end there: leaves let some pass, and a wall lets none.
"""

from collections.abc import Mapping

import numpy as np

from nav.fusion.scan_geometry import ScanGeometry, rotation
from nav.messages import Floats, LidarScan
from nav.parameters.vehicle import VehicleParameters

SOLID_BEAMS = 12
"""Neighbours that must end close ahead: 6 degrees, 0.15 m at 1.5 m. Of a bush that lets half of
the beams pass, one scan in fifty shows so many."""
REACH_M = 5.0
"""Ahead of the bumper; farther away nothing is of interest."""
GROUND_M = 0.25
"""What is lower than this is taken for ground."""


def confirmed_m(
    scans: Mapping[str, LidarScan],
    geometry: Mapping[str, ScanGeometry],
    sonar_m: Mapping[str, float],
    vehicle: VehicleParameters,
    tilt_rad: tuple[float, float],
) -> float:
    """Distance ahead of the bumper that a second sensor confirms, at most REACH_M, [m].

    Args:
        scans: the newest scan of each scanner that speaks.
        geometry: of the scanners, by name.
        sonar_m: newest ranges by name.
        vehicle: outline and mounts.
        tilt_rad: roll and pitch: with the nose in a hole, the ground ahead is no wall.
    """
    level = rotation(*tilt_rad, 0.0)
    near = [_solid_m(level @ geometry[n].mount, geometry[n], s, vehicle) for n, s in scans.items()]
    echoes = [r for name, r in sonar_m.items() if name.startswith("front_") and r > 0.0]
    nearest = sorted([*near, min(echoes, default=REACH_M)])
    return min(nearest[1], REACH_M) if len(nearest) > 1 else REACH_M


def _solid_m(
    mount: Floats, geometry: ScanGeometry, scan: LidarScan, vehicle: VehicleParameters
) -> float:
    """Nearest run of neighbouring returns in the way of the vehicle; `mount` is in level axes."""
    place = mount[:, :2] @ (geometry.ray * scan.range_m) + mount[:, 2:]
    ahead = place[0] - vehicle.outline.front_m
    in_way = (np.abs(place[1]) < vehicle.outline.half_width_m) & (place[2] > GROUND_M)
    close = in_way & (ahead > -0.1) & (ahead < REACH_M) & (scan.range_m > geometry.exit_m)
    run = np.convolve(close, np.ones(SOLID_BEAMS), "valid") >= SOLID_BEAMS - 0.5
    if not run.any():
        return REACH_M
    first = int(run.argmax())
    return float(np.median(ahead[first : first + SOLID_BEAMS]))
