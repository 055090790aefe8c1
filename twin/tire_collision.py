"""Contacts of a tire with the ground: our own function for them in MuJoCo's collision table.

MuJoCo intersects a tire with each prism under the ground's triangles, by a search, and that was
half of all physics. A tire is an ellipsoid. Stretch space so that it becomes the unit sphere around
the origin: then the point of a triangle that is deepest in the tire is the one closest to the
origin, and there is a formula for it. As in MuJoCo, each triangle that reaches into the tire gives
one contact; on a face the two agree within the tolerance of its search, on an edge up to the second
order of the depth.

Only geoms whose `user` value is TIRE come here; every other ellipsoid, and whatever is unusual,
goes on to MuJoCo's function.

Compiled without fastmath, so that bits are the same everywhere. Compiled code calls none outside
its own file: numba's cache notices changes only there.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import llvmlite.binding as llvm
import mujoco
import numpy as np
from numba import cfunc, njit, types
from numba.extending import intrinsic

from twin.mujoco_memory import Words, collision_table, words

Vector = tuple[float, float, float]

TIRE = 2005.0
"""First `user` value of a geom whose contacts with height fields are computed here."""
MOST = 50
"""Contacts that MuJoCo has room for (mjMAXCONPAIR)."""
SIZE = 10
"""Numbers in a contact (mjPreContact): distance [m], position [m], normal from ground to tire,
tangent (zero: MuJoCo chooses)."""
UNUSUAL = -1
"""Instead of a number of contacts: the tire's centre is below a triangle that reaches into it."""

_SIGNATURE = types.int32(
    types.CPointer(types.int64), types.CPointer(types.int64), types.CPointer(types.float64),
    types.int32, types.int32, types.float64,
)  # fmt: skip
"""mjfCollision: model, data, the contacts to fill in, two geoms, margin; the number of contacts.
The structs of MuJoCo are to us arrays of words, most of them addresses."""
STOCK_NAME = "ion_twin_stock_hfield_ellipsoid"
"""The symbol under which compiled code finds MuJoCo's function: its address is not the same in
every process, and numba's cache would keep it."""
_stock: Any = types.ExternalFunction(STOCK_NAME, _SIGNATURE)
_compiled: Any = njit(error_model="numpy", _nrt=False, forceinline=True)  # pyright: ignore
_c_function: Any = cfunc(_SIGNATURE, cache=True, error_model="numpy", _nrt=False)  # pyright: ignore


class Tire(NamedTuple):
    """An ellipsoid."""

    center: Vector
    axes: tuple[Vector, Vector, Vector]
    """Its own axes in the world frame."""
    half: Vector
    """Its half axes [m]."""


class Ground(NamedTuple):
    """A height field as MuJoCo has it: triangles along the diagonal (i, j) to (i + 1, j + 1)."""

    z: Any
    """Pointer to heights, row after row, in units of `top_m`."""
    rows: int
    columns: int
    center: Vector
    axes: tuple[Vector, Vector, Vector]
    """Its own axes in the world frame; rows follow one another along the second."""
    half_x: float
    half_y: float
    top_m: float


@_compiled
def contacts(ground: Ground, tire: Tire, out: Any) -> int:
    """Fill in `out`, a pointer to MOST records of SIZE numbers.

    Returns:
        The number of contacts, or UNUSUAL.
    """
    dx = 2.0 * ground.half_x / (ground.columns - 1)
    dy = 2.0 * ground.half_y / (ground.rows - 1)
    ex, ey, ez = ground.axes
    away = _sum(ground.center, tire.center, -1.0)
    corner = _sum(_sum(away, ex, -ground.half_x), ey, -ground.half_y)
    first_j, last_j = _cells(-_dot(corner, ex), _reach(tire, ex), dx, ground.columns)
    first_i, last_i = _cells(-_dot(corner, ey), _reach(tire, ey), dy, ground.rows)
    lowest = (-_dot(corner, ez) - _reach(tire, ez)) / ground.top_m
    origin = _stretched(tire, corner, 1.0)
    step_x, step_y = _stretched(tire, ex, dx), _stretched(tire, ey, dy)
    lattice = (step_x, step_y, _stretched(tire, ez, ground.top_m))
    count = 0
    for i in range(first_i, last_i):
        for j in range(first_j, last_j):
            at = i * ground.columns + j
            z, z_x = ground.z[at], ground.z[at + 1]
            z_y, z_xy = ground.z[at + ground.columns], ground.z[at + ground.columns + 1]
            if max(z, z_x, z_y, z_xy) < lowest:
                continue
            a = _sum(origin, _combined(lattice, j, i, z), 1.0)
            b = _sum(origin, _combined(lattice, j + 1, i, z_x), 1.0)
            c = _sum(origin, _combined(lattice, j + 1, i + 1, z_xy), 1.0)
            d = _sum(origin, _combined(lattice, j, i + 1, z_y), 1.0)
            for p, q in ((c, d), (b, c)):
                deepest = _closest(a, p, q)
                if _dot(deepest, deepest) < 1.0 and count < MOST:
                    if _below(a, p, q):
                        return UNUSUAL
                    _write(tire, deepest, out, count * SIZE)
                    count += 1
    return count


@_compiled
def _cells(at: float, reach: float, side: float, points: int) -> tuple[int, int]:
    """First cell and the one after the last along an axis of `points` vertices."""
    first, last = np.floor((at - reach) / side), np.ceil((at + reach) / side)
    return int(_clipped(first, points - 1.0)), int(_clipped(last, points - 1.0))


@_compiled
def _clipped(value: float, top: float) -> float:
    """Into [0, top]; 0 for what is not a number."""
    if value > 0.0:
        return min(value, top)
    return 0.0


@_compiled
def _write(tire: Tire, deepest: Vector, out: Any, at: int) -> None:
    """One contact into `out` from `at` on, from the deepest point of a triangle, stretched."""
    r = np.sqrt(_dot(deepest, deepest))
    x, y, z = deepest[0] / r, deepest[1] / r, deepest[2] / r
    a, b, c = tire.half
    surface = _combined(tire.axes, x * a, y * b, z * c)
    normal = _combined(tire.axes, -x / a, -y / b, -z / c)
    support = 1.0 / np.sqrt(_dot(normal, normal))  # from the centre to the tangent plane there
    depth = (1.0 - r) * support
    out[at] = -depth
    for k in range(3):
        out[at + 1 + k] = tire.center[k] + surface[k] + 0.5 * depth * support * normal[k]
        out[at + 4 + k] = support * normal[k]
        out[at + 7 + k] = 0.0


@_compiled
def _closest(a: Vector, b: Vector, c: Vector) -> Vector:
    """The point of a triangle that is closest to the origin (Ericson 2005, section 5.1.5)."""
    ab, ac = _sum(b, a, -1.0), _sum(c, a, -1.0)
    ab_a, ac_a = -_dot(ab, a), -_dot(ac, a)
    if ab_a <= 0.0 and ac_a <= 0.0:
        return a
    ab_b, ac_b = -_dot(ab, b), -_dot(ac, b)
    if ab_b >= 0.0 and ac_b <= ab_b:
        return b
    ab_c, ac_c = -_dot(ab, c), -_dot(ac, c)
    if ac_c >= 0.0 and ab_c <= ac_c:
        return c
    weight_c = ab_a * ac_b - ab_b * ac_a
    if weight_c <= 0.0 and ab_a >= 0.0 and ab_b <= 0.0:
        return _sum(a, ab, ab_a / (ab_a - ab_b))
    weight_b = ab_c * ac_a - ab_a * ac_c
    if weight_b <= 0.0 and ac_a >= 0.0 and ac_c <= 0.0:
        return _sum(a, ac, ac_a / (ac_a - ac_c))
    weight_a = ab_b * ac_c - ab_c * ac_b
    to_c, to_b = ac_b - ab_b, ab_c - ac_c
    if weight_a <= 0.0 and to_c >= 0.0 and to_b >= 0.0:
        return _sum(b, _sum(c, b, -1.0), to_c / (to_c + to_b))
    total = weight_a + weight_b + weight_c
    return _sum(_sum(a, ab, weight_b / total), ac, weight_c / total)


@_compiled
def _below(a: Vector, b: Vector, c: Vector) -> bool:
    """Whether the origin is on or below the plane of a triangle, counter-clockwise from above."""
    p, q = _sum(b, a, -1.0), _sum(c, a, -1.0)
    up = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
    return _dot(up, a) >= 0.0


@_compiled
def _stretched(tire: Tire, v: Vector, length: float) -> Vector:
    """`length` times v in the frame in which the tire is the unit sphere."""
    p, q, r = tire.axes
    a, b, c = tire.half
    return length * _dot(p, v) / a, length * _dot(q, v) / b, length * _dot(r, v) / c


@_compiled
def _reach(tire: Tire, direction: Vector) -> float:
    """How far the tire extends from its centre, [m]."""
    p, q, r = tire.axes
    a, b, c = tire.half
    v = (a * _dot(p, direction), b * _dot(q, direction), c * _dot(r, direction))
    return np.sqrt(_dot(v, v))


@_compiled
def _combined(axes: tuple[Vector, Vector, Vector], x: float, y: float, z: float) -> Vector:
    """The vector with these coordinates along the axes."""
    p, q, r = axes
    return (
        p[0] * x + q[0] * y + r[0] * z,
        p[1] * x + q[1] * y + r[1] * z,
        p[2] * x + q[2] * y + r[2] * z,
    )


@_compiled
def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@_compiled
def _sum(a: Vector, b: Vector, t: float) -> Vector:
    """a + t b."""
    return a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]


# ---------------------------------------------------------------- in MuJoCo's memory


def _pointer_to(kind: Any) -> Any:
    """A function for compiled code: an address as a pointer to `kind`, which can be indexed."""

    @intrinsic
    def cast(typing: Any, address: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return builder.inttoptr(arguments[0], context.get_value_type(signature.return_type))

        return types.CPointer(kind)(address), generate

    return cast


_doubles, _floats, _ints = (
    _pointer_to(kind) for kind in (types.float64, types.float32, types.int32)
)


@_compiled
def _vector(p: Any, start: int) -> Vector:
    return p[start], p[start + 1], p[start + 2]


@_compiled
def _axes(p: Any, start: int) -> tuple[Vector, Vector, Vector]:
    """The columns of a rotation matrix."""
    a, b, c = _vector(p, start), _vector(p, start + 3), _vector(p, start + 6)
    return (a[0], b[0], c[0]), (a[1], b[1], c[1]), (a[2], b[2], c[2])


@_compiled
def _is_tire(model: Any, at: Words, geom: int) -> bool:
    values = model[at.nuser_geom]
    return values > 0 and _doubles(model[at.geom_user])[values * geom] == TIRE


@_compiled
def _tire(model: Any, data: Any, at: Words, geom: int) -> Tire:
    return Tire(
        _vector(_doubles(data[at.geom_xpos]), 3 * geom),
        _axes(_doubles(data[at.geom_xmat]), 9 * geom),
        _vector(_doubles(model[at.geom_size]), 3 * geom),
    )


@_compiled
def _ground(model: Any, data: Any, at: Words, geom: int) -> Ground:
    field = _ints(model[at.geom_dataid])[geom]
    start = _ints(model[at.hfield_adr])[field]
    half_x, half_y, top = _vector(_doubles(model[at.hfield_size]), 4 * field)
    return Ground(
        _floats(model[at.hfield_data] + 4 * start),
        _ints(model[at.hfield_nrow])[field],
        _ints(model[at.hfield_ncol])[field],
        _vector(_doubles(data[at.geom_xpos]), 3 * geom),
        _axes(_doubles(data[at.geom_xmat]), 9 * geom),
        half_x,
        half_y,
        top,
    )


def _collision(at: Words) -> Any:
    """The C function. It closes over `at`, since numba's cache looks at what is closed over."""

    @_c_function
    def collide(model, data, out, ground, tire, margin):
        count = UNUSUAL
        if _is_tire(model, at, tire) and margin <= 0.0:
            field = _ground(model, data, at, ground)
            count = contacts(field, _tire(model, data, at, tire), out)
        if count == UNUSUAL:
            return _stock(model, data, out, ground, tire, margin)
        return count

    return collide


_installed: Any = None
"""Keeps the compiled function alive."""


def install() -> None:
    """Put our function into MuJoCo's table, once a process.

    Raises:
        RuntimeError: this MuJoCo lays out its structs in another way than it declares.
    """
    global _installed
    if _installed is not None:
        return
    at = words()
    on_hfield = collision_table()[int(mujoco.mjtGeom.mjGEOM_HFIELD)]
    ellipsoid = int(mujoco.mjtGeom.mjGEOM_ELLIPSOID)
    llvm.add_symbol(STOCK_NAME, on_hfield[ellipsoid])
    _installed = _collision(at)
    on_hfield[ellipsoid] = _installed.address


@contextmanager
def stock() -> Iterator[None]:
    """Once ours is installed: MuJoCo's own function is back in its table for a while."""
    on_hfield = collision_table()[int(mujoco.mjtGeom.mjGEOM_HFIELD)]
    ellipsoid = int(mujoco.mjtGeom.mjGEOM_ELLIPSOID)
    ours, on_hfield[ellipsoid] = on_hfield[ellipsoid], llvm.address_of_symbol(STOCK_NAME)
    try:
        yield
    finally:
        on_hfield[ellipsoid] = ours
