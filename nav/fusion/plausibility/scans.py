"""Whether a LIDAR's ranges can be true: neither noise nor one offset of all beams."""

from dataclasses import dataclass, field

import numpy as np

from nav.fusion.plausibility.steps import Steps
from nav.fusion.plausibility.witnesses import Ego
from nav.messages import LIDAR_NO_RETURN_M, Floats, LidarScan
from nav.parameters.plausibility import ScanParameters

STANDS_MPS = 0.05


@dataclass
class Scans:
    """What one scanner said last, and when it was looked at closely."""

    parameters: ScanParameters
    height_m: float
    """Of the scanner above the ground."""
    range_m: Floats | None = None
    time_ns: int = 0
    steps: Steps = field(init=False)
    looked_ns: int = 0

    def __post_init__(self) -> None:
        self.steps = Steps(self.parameters.step, self.height_m)

    def wrong(self, scan: LidarScan, ego: Ego) -> str | None:
        """Why a scan is implausible, or nothing; None where it is not looked at closely."""
        speed_mps = ego.speed_mps
        p, before, past_ns = self.parameters, self.range_m, self.time_ns
        self.range_m, self.time_ns = scan.range_m, scan.time_ns
        if before is None:
            return ""
        self.steps.observe(scan.range_m, speed_mps * (scan.time_ns - past_ns) * 1e-9)
        if scan.time_ns - self.looked_ns < p.every_s * 1e9:
            return None
        self.looked_ns = scan.time_ns
        if scan.range_m.tobytes() == before.tobytes():
            return "frozen" if np.count_nonzero(before < LIDAR_NO_RETURN_M) >= p.least else None
        if abs(self.steps.sum_m) > p.step.least_m:
            return f"all its ranges changed by {self.steps.sum_m:.1f} m"
        if ego.rocking_radps > p.rocking_radps:  # over a bump: beams sweep the ground
            return None
        stands = abs(speed_mps) < STANDS_MPS  # so what is far away looks the same, too
        steady = steadiness(before, scan.range_m, LIDAR_NO_RETURN_M if stands else p.near_m, p)
        if steady is None:
            return None
        return "noisy" if steady < p.steady_share else ""


def steadiness(before_m: Floats, range_m: Floats, near_m: float, p: ScanParameters) -> float | None:
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
