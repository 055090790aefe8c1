"""The walk of a ray: block by block through empty air, cell by cell near the ground.

The walk is Amanatides and Woo's (1987).
Compiled without fastmath, so that bits are the same everywhere, and with finite sentinels.
Compiled code calls none outside its own file: numba's cache notices changes only there.
`_nrt=False` leaves out the counting of references, which cost more than the walk itself.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from twin.raycast.geometry import BOX, GROUND, NO_HIT, Floats, Geometry, Ground, Records

Vector = tuple[float, float, float]

FAR = 1e18
"""Beyond every range, [m]: the finite stand-in for infinity."""

_compiled: Any = njit(cache=True, error_model="numpy", _nrt=False, forceinline=True)  # pyright: ignore


@_compiled
def cast_all(
    geometry: Geometry, origins: Floats, rotations: Floats, directions: Floats, max_range: float,
    range_m: Floats, what: NDArray[np.int32],
) -> None:  # fmt: skip
    """Fill range_m (m, n) and what (m, n) for rays from each of the origins (m, 3).

    Their directions (n, 3) are turned by its rotation, one of (m, 3, 3).
    """
    for k in range(origins.shape[0]):
        start = (origins[k, 0], origins[k, 1], origins[k, 2])
        r = rotations[k]
        for i in range(directions.shape[0]):
            direction = _turned(r, directions[i, 0], directions[i, 1], directions[i, 2])
            range_m[k, i], what[k, i] = _cast(geometry, start, direction, max_range)


@_compiled
def hide_all(
    geometry: Geometry, origins: Floats, rotations: Floats, directions: Floats, max_range: float,
    opacity: Floats, drawn: Floats, range_m: Floats,
) -> None:  # fmt: skip
    """Shorten range_m (m, n) of the rays of `cast_all` that a solid of this geometry holds back:
    where drawn (m, n) is less than its opacity, one of (solids,).

    Few rays come near any solid, so the others are not walked; there are only a few solids.
    """
    densest = 0.0
    for solid in range(opacity.size):
        densest = max(densest, opacity[solid])
    for k in range(origins.shape[0]):
        start = (origins[k, 0], origins[k, 1], origins[k, 2])
        r = rotations[k]
        for i in range(directions.shape[0]):
            if drawn[k, i] >= densest:
                continue
            direction = _turned(r, directions[i, 0], directions[i, 1], directions[i, 2])
            if _nearest(geometry.solids, start, direction) < range_m[k, i]:
                veiled, what = _cast(geometry, start, direction, max_range)
                if what >= 0 and veiled < range_m[k, i] and drawn[k, i] < opacity[what]:
                    range_m[k, i] = veiled


@_compiled
def _turned(r: Floats, x: float, y: float, z: float) -> Vector:
    """The vector x, y, z turned by a rotation (3, 3)."""
    return (
        r[0, 0] * x + r[0, 1] * y + r[0, 2] * z,
        r[1, 0] * x + r[1, 1] * y + r[1, 2] * z,
        r[2, 0] * x + r[2, 1] * y + r[2, 2] * z,
    )


@_compiled
def _nearest(solids: Records, origin: Vector, direction: Vector) -> float:
    """Range [m] at which a ray first meets any of the solids, were there no ground; else FAR."""
    range_m = FAR
    for k in range(solids.size):
        range_m = min(range_m, _meet(solids[k], origin, direction))
    return range_m


@_compiled
def _cast(
    geometry: Geometry, origin: Vector, direction: Vector, max_range: float
) -> tuple[float, int]:
    """Range [m] of one ray and what it hit; max_range and NO_HIT if nothing."""
    ground, blocks = geometry.ground, geometry.ground.blocks
    side, count = ground.block_cells * ground.spacing, ground.blocks.shape[0]
    x, y = origin[0] - ground.x0, origin[1] - ground.y0
    px, py, dx, dy = x / side, y / side, direction[0] / side, direction[1] / side
    inv_x, inv_y = _inverse(dx), _inverse(dy)
    t, end = _inside((px, py), (inv_x, inv_y), (ground.z.shape[0] - 1) / ground.block_cells)
    t, end = max(t, 0.0), min(end, max_range)
    best, what = end, NO_HIT
    if t >= end:
        return max_range, what
    column, step_x, next_x, delta_x = _axis(px, dx, inv_x, t, count)
    row, step_y, next_y, delta_y = _axis(py, dy, inv_y, t, count)
    while 0 <= column < count and 0 <= row < count:
        leave = min(next_x, next_y, end)
        block = blocks[row, column]
        if block.top >= origin[2] + direction[2] * (t if direction[2] > 0.0 else leave):
            for k in range(block.first, block.last):
                hit = _meet(geometry.solids[geometry.members[k]], origin, direction)
                if hit < best:
                    best, what = hit, geometry.members[k]
        corner = (x - column * side, y - row * side, origin[2])
        first, last = _below_lid(block, corner, direction, t, min(leave, best))
        if first <= last:
            hit = _meet_ground(ground, origin, direction, first, last)
            if hit < best:
                best, what = hit, GROUND
        if best <= leave:
            break
        t = leave
        if next_x < next_y:
            column, next_x = column + step_x, next_x + delta_x
        else:
            row, next_y = row + step_y, next_y + delta_y
    return best if what != NO_HIT else max_range, what


@_compiled
def _inverse(d: float) -> float:
    """1 / d, or FAR for a direction that never gets there."""
    return 1.0 / d if abs(d) > 1.0 / FAR else FAR


@_compiled
def _inside(p: tuple[float, float], inv: tuple[float, float], size: float) -> tuple[float, float]:
    """First and last t of p + t / inv within the square [0, size]^2; first > last if it misses."""
    ax, bx = -p[0] * inv[0], (size - p[0]) * inv[0]
    ay, by = -p[1] * inv[1], (size - p[1]) * inv[1]
    return max(min(ax, bx), min(ay, by)), min(max(ax, bx), max(ay, by))


@_compiled
def _axis(p: float, d: float, inv: float, t: float, count: int) -> tuple[int, int, float, float]:
    """Along one axis of unit cells: cell of p + d t, step, t of the next border, t a cell."""
    cell = min(max(int(np.floor(p + d * t)), 0), count - 1)
    if inv > 0.0:
        return cell, 1, (cell + 1 - p) * inv, inv
    return cell, -1, (cell - p) * inv, -inv


@_compiled
def _meet(solid: Any, origin: Vector, direction: Vector) -> float:
    """Range [m] at which a ray meets a SOLID, from outside or from inside; FAR if it does not."""
    ox, oy, oz = origin
    dx, dy, dz = direction
    cx, cy, cz = solid.center[0] - ox, solid.center[1] - oy, solid.center[2] - oz
    along = cx * dx + cy * dy + cz * dz
    if cx * cx + cy * cy + cz * cz - along * along > solid.radius2:
        return FAR
    axes = solid.axes
    px = -(axes[0, 0] * cx + axes[0, 1] * cy + axes[0, 2] * cz)
    py = -(axes[1, 0] * cx + axes[1, 1] * cy + axes[1, 2] * cz)
    pz = -(axes[2, 0] * cx + axes[2, 1] * cy + axes[2, 2] * cz)
    qx = axes[0, 0] * dx + axes[0, 1] * dy + axes[0, 2] * dz
    qy = axes[1, 0] * dx + axes[1, 1] * dy + axes[1, 2] * dz
    qz = axes[2, 0] * dx + axes[2, 1] * dy + axes[2, 2] * dz
    near, far = _slab(pz, qz, solid.half[2])
    if solid.shape == BOX:
        near_x, far_x = _slab(px, qx, solid.half[0])
        near_y, far_y = _slab(py, qy, solid.half[1])
        near, far = max(near, near_x, near_y), min(far, far_x, far_y)
    else:
        near_r, far_r = _tube(px, py, qx, qy, solid.half[0])
        near, far = max(near, near_r), min(far, far_r)
    if near > far or far < 0.0:
        return FAR
    return near if near >= 0.0 else far


@_compiled
def _slab(p: float, q: float, half: float) -> tuple[float, float]:
    """Where p + q t enters and leaves [-half, half]."""
    if abs(q) < 1e-15:
        return (-FAR, FAR) if abs(p) <= half else (FAR, -FAR)
    a, b = (-half - p) / q, (half - p) / q
    return min(a, b), max(a, b)


@_compiled
def _tube(px: float, py: float, qx: float, qy: float, radius: float) -> tuple[float, float]:
    """Where a ray enters and leaves an endless cylinder about z."""
    a, b, c = qx * qx + qy * qy, px * qx + py * qy, px * px + py * py - radius * radius
    if a < 1e-18:
        return (-FAR, FAR) if c <= 0.0 else (FAR, -FAR)
    square = b * b - a * c
    if square < 0.0:
        return FAR, -FAR
    root = np.sqrt(square)
    return (-b - root) / a, (-b + root) / a


@_compiled
def _below_lid(
    block: Any, origin: Vector, direction: Vector, first: float, last: float
) -> tuple[float, float]:
    """The part of [first, last] in which the ray runs below the lid of a BLOCK, else (FAR, -FAR).

    The origin is given from the block's corner; the height above the lid is over + rate t.
    """
    over = origin[2] - block.lid - block.slope_x * origin[0] - block.slope_y * origin[1]
    rate = direction[2] - block.slope_x * direction[0] - block.slope_y * direction[1]
    enters, leaves = over + rate * first <= 0.0, over + rate * last <= 0.0
    if enters and leaves:
        return first, last
    if not enters and not leaves:
        return FAR, -FAR
    border = min(max(-over / rate, first), last)
    return (first, border) if enters else (border, last)


@_compiled
def _meet_ground(
    ground: Ground, origin: Vector, direction: Vector, first: float, last: float
) -> float:
    """Range [m] at which the ray goes below the ground within [first, last]; FAR if it does not."""
    z, spacing = ground.z, ground.spacing
    cells = z.shape[0] - 1
    px, py = (origin[0] - ground.x0) / spacing, (origin[1] - ground.y0) / spacing
    dx, dy = direction[0] / spacing, direction[1] / spacing
    j, step_x, next_x, delta_x = _axis(px, dx, _inverse(dx), first, cells)
    i, step_y, next_y, delta_y = _axis(py, dy, _inverse(dy), first, cells)
    t = first
    while True:
        leave = min(next_x, next_y, last)
        lowest = origin[2] + direction[2] * (t if direction[2] > 0.0 else leave)
        if lowest <= max(max(z[i, j], z[i, j + 1]), max(z[i + 1, j], z[i + 1, j + 1])):
            hit = _meet_cell(
                z[i : i + 2, j : j + 2],
                (px - j, py - i, origin[2]),
                (dx, dy, direction[2]),
                t,
                leave,
            )
            if hit < FAR:
                return hit
        if leave >= last:
            return FAR
        t = leave
        if next_x < next_y:
            j, next_x = j + step_x, next_x + delta_x
        else:
            i, next_y = i + step_y, next_y + delta_y
        if i < 0 or j < 0 or i >= cells or j >= cells:
            return FAR


@_compiled
def _meet_cell(z: Floats, p: Vector, d: Vector, t: float, leave: float) -> float:
    """As `_meet_ground`, in one cell of unit size with the heights z (2, 2), on [t, leave].

    The diagonal x = y parts the cell; a ray that crosses it meets one triangle after the other.
    """
    before, after = (p[0] - p[1]) + (d[0] - d[1]) * t, (p[0] - p[1]) + (d[0] - d[1]) * leave
    if (before >= 0.0) == (after >= 0.0):
        return _meet_triangle(z, before >= 0.0, p, d, t, leave)
    middle = t + (leave - t) * before / (before - after)
    hit = _meet_triangle(z, before >= 0.0, p, d, t, middle)
    return hit if hit < FAR else _meet_triangle(z, after >= 0.0, p, d, middle, leave)


@_compiled
def _meet_triangle(
    z: Floats, lower_right: bool, p: Vector, d: Vector, t: float, leave: float
) -> float:
    """As `_meet_cell`, for the triangle x >= y or the other: the gap over it is linear in t."""
    if lower_right:
        slope_x, slope_y = z[0, 1] - z[0, 0], z[1, 1] - z[0, 1]
    else:
        slope_x, slope_y = z[1, 1] - z[1, 0], z[1, 0] - z[0, 0]
    gap = p[2] - z[0, 0] - slope_x * p[0] - slope_y * p[1]
    rate = d[2] - slope_x * d[0] - slope_y * d[1]
    if gap + rate * leave > 0.0:
        return FAR
    return t if gap + rate * t <= 0.0 else min(max(-gap / rate, t), leave)
