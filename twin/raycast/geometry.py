"""What a ray needs to know, in the form that compiled code takes: plain arrays of records."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Records = NDArray[Any]

GROUND = -1
"""What a ray hit: the ground. Zero and more is the index of an obstacle."""
NO_HIT = -2
"""What a ray hit: nothing."""
BOX = 0
CYLINDER = 1

SOLID = np.dtype(
    [
        ("shape", np.int64),  # BOX or CYLINDER
        ("center", np.float64, 3),  # [m]
        ("axes", np.float64, (3, 3)),  # rows: its own axes in the world frame
        ("half", np.float64, 3),  # half size [m]; a cylinder's: radius, radius, half height
        ("reach", np.float64, 3),  # half size of the upright box around it [m]
        ("radius2", np.float64),  # squared radius of the sphere around it [m^2]
    ],
    align=True,
)
"""A rigid thing in the world frame: one compact record, since a ray reads all of it."""


BLOCK = np.dtype(
    [
        ("lid", np.float64),  # height of its upper plane at its corner [m]
        ("slope_x", np.float64),
        ("slope_y", np.float64),
        ("top", np.float64),  # highest point of the solids in it [m], very low without any
        ("first", np.int64),  # its solids are members[first:last]
        ("last", np.int64),
    ],
    align=True,
)
"""A square of BLOCK_CELLS x BLOCK_CELLS cells: a plane above all of its ground, and its solids."""


class Ground(NamedTuple):
    """A square lattice of heights, triangulated along the diagonal (i, j) to (i + 1, j + 1).

    That is the diagonal of MuJoCo's hfield.
    """

    z: Floats
    """Shape (n, n), [m]: z[row, column], rows along y."""
    x0: float
    y0: float
    """Position of z[0, 0], [m]."""
    spacing: float
    """[m]."""
    block_cells: int
    """Cells a side of one block."""
    blocks: Records
    """Shape (b, b) of BLOCK."""


class Geometry(NamedTuple):
    """The ground, and the solids sorted into its blocks."""

    ground: Ground
    solids: Records
    """Shape (n,) of SOLID."""
    members: NDArray[np.int32]
    """Indices of the solids of every block, block after block."""
