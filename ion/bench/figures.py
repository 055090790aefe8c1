"""What a bench run found, from its slices."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from ion.bench.race import Slice
from twin.simulator import TICK_S


@dataclass(frozen=True)
class Figures:
    """In the order in which they are told. All are medians over the slices."""

    full_over_bare: float
    """Wall time of the full loop over that of bare physics with stock MuJoCo."""
    embree_over_ours: float | None
    """Time of a ray, Embree's over ours; None without Embree."""
    lidar_us_per_ray: float
    """Ours, [us]."""
    real_time_factor: float
    """Simulated over wall time of the full loop."""
    parts: dict[str, float]
    """Wall time of each part of the full loop in a simulated second, [ms]."""


def figures(ticks: Sequence[int], slices: Sequence[Slice], shares: dict[str, float]) -> Figures:
    """From slices of so many ticks of 20 ms each, and the share of each part."""
    factor = median(n * TICK_S / s.full_s for n, s in zip(ticks, slices, strict=False))
    return Figures(
        full_over_bare=median(s.full_s / s.bare_s for s in slices),
        embree_over_ours=_over_ours(slices),
        lidar_us_per_ray=1e6 * median(s.ray.ours_s for s in slices),
        real_time_factor=factor,
        parts={part: share * 1e3 / factor for part, share in shares.items()},
    )


def _over_ours(slices: Sequence[Slice]) -> float | None:
    rays = [s.ray for s in slices]
    ratios = [ray.embree_s / ray.ours_s for ray in rays if ray.embree_s is not None]
    return median(ratios) if ratios else None
