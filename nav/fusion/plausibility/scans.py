"""Whether a LIDAR's ranges can be true: neither noise nor one offset of all beams."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from nav.fusion.plausibility.witnesses import Ego
from nav.messages import Floats, LidarScan
from nav.parameters.plausibility import ScanParameters

NO_RETURN_M = 81.92
STANDS_MPS = 0.05
LOW_M = 0.5
"""No scanner sits lower above the ground."""
ROUGH = 0.06
"""So much the vehicle rises or falls, a metre of way (estimated: slopes of courses, and bumps)."""
EVERY = 4
"""So many beams are enough to see that all have jumped."""


class Moved(NamedTuple):
    """How the vehicle has moved from one scan to the next."""

    way_m: float
    tilt_rad: float
    """Rolled and pitched."""


@dataclass
class Scans:
    """What one scanner said last, and when it was looked at closely."""

    parameters: ScanParameters
    range_m: Floats | None = None
    time_ns: int = 0
    shift_m: float = 0.0
    """By how much all its ranges have jumped so far."""
    looked_ns: int = 0

    def wrong(self, scan: LidarScan, ego: Ego) -> str | None:
        """Why a scan is implausible, or nothing; None where it is not looked at closely."""
        speed_mps = ego.speed_mps
        p, before, past_ns = self.parameters, self.range_m, self.time_ns
        self.range_m, self.time_ns = scan.range_m, scan.time_ns
        if before is None:
            return ""
        since_s = (scan.time_ns - past_ns) * 1e-9
        moved = Moved(abs(speed_mps) * since_s, ego.rocking_radps * since_s)
        self.shift_m += jump_m(before[::EVERY], scan.range_m[::EVERY], moved, p)
        if scan.time_ns - self.looked_ns < p.every_s * 1e9:
            return None
        self.looked_ns = scan.time_ns
        if scan.range_m.tobytes() == before.tobytes():
            return "frozen" if np.count_nonzero(before < NO_RETURN_M) >= p.least else None
        if abs(self.shift_m) > p.jump_m:
            return f"all its ranges changed by {self.shift_m:.1f} m"
        if ego.rocking_radps > p.rocking_radps:  # over a bump: beams sweep the ground
            return None
        stands = abs(speed_mps) < STANDS_MPS  # so what is far away looks the same, too
        steady = steadiness(before, scan.range_m, NO_RETURN_M if stands else p.near_m, p)
        if steady is None:
            return None
        return "noisy" if steady < p.steady_share else ""


def steadiness(
    before_m: Floats, range_m: Floats, near_m: float, p: ScanParameters
) -> float | None:
    """The share of beams nearer than `near_m` whose range changes as their neighbour's from scan to
    scan.

    Of the world it is large: what one beam sees come nearer, so does its neighbour, and edges and
    rough ground look the same a scan later. Dust and leaves, which some beams pass, leave a half or
    a third of it, noise an eighth. None where too few are near.
    """
    near = (before_m < near_m) & (range_m < near_m)
    pair = near[:-1] & near[1:]
    count = np.count_nonzero(pair)
    if count < p.least:
        return None
    change = range_m - before_m
    alike = np.abs(change[1:] - change[:-1]) < p.steady_m
    return np.count_nonzero(alike & pair) / count


def jump_m(before_m: Floats, range_m: Floats, moved: Moved, p: ScanParameters) -> float:
    """By how much all ranges have changed alike, [m]; 0 where they have not.

    The world does not do that: what the vehicle nears on its way comes nearer by the cosine of its
    bearing; as it rises, ground moves by its range over the scanner's height, and as it pitches, by
    the square of that range: slopes that are grazed in 40 m move by more than half a metre.
    """
    change = range_m - before_m
    jumped = np.abs(change) > p.jump_m
    if EVERY * np.count_nonzero(jumped) < p.jump_least:  # as nearly always: no need to look closer
        return 0.0
    both = np.flatnonzero((before_m < NO_RETURN_M) & (range_m < NO_RETURN_M))
    if EVERY * both.size < p.jump_least or EVERY * (both[-1] - both[0]) < p.span:
        return 0.0
    change = change[both]
    middle = _median(change)
    if abs(middle) < p.jump_m + moved.way_m + _ground_m(_median(before_m[both]), moved, p):
        return 0.0
    alike = np.count_nonzero(np.abs(change - middle) < p.alike_m)
    return middle if alike > p.alike_share * change.size else 0.0


def _ground_m(range_m: float, moved: Moved, p: ScanParameters) -> float:
    """By how much the range of ground may have changed, [m]."""
    grazed = range_m > p.near_m  # nearer, things are met
    rise_m = ROUGH * moved.way_m if grazed else 0.0
    return range_m * (range_m * moved.tilt_rad + rise_m) / LOW_M


def _median(values: Floats) -> float:
    """numpy's own takes five times as long."""
    half = values.size // 2
    return float(np.partition(values, half)[half])
