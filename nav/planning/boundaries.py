"""The two-step expansion of obstacles (section 6.4.2.1): real and safe boundaries.

The real boundary is an obstacle expanded by half the vehicle, so that the vehicle becomes a point;
the safe boundary is enlarged further and envelops it.

A disc is a stack of rows of different widths. Rows of the grid are packed 64 cells a word, so that
widening is a shift of words and stacking an "or" of rows: its cost does not depend on the number
of obstacles, and from 300 on it is cheaper than painting a disc around each.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nav.errors import NavError

FREE, SAFE, REAL, TOUCH = 0, 1, 2, 3
"""Outside all boundaries, inside the safe one, inside the real one, and where the outline itself
would touch: beyond the paper, so that a vehicle that strays into the real boundary may leave it."""

Cells = NDArray[np.uint8]
Bools = NDArray[np.bool_]
_Words = NDArray[np.uint64]
_WORD = 64


class Layer(NamedTuple):
    """One boundary."""

    radius_m: float
    """Obstacles are expanded by this."""
    outside: Bools | None = None
    """Shape (count, count): cells outside the corridor as it is shrunk for this boundary."""


def boundaries(
    occupied: NDArray[np.int64], count: int, cell_m: float, layers: Sequence[Layer]
) -> Cells:
    """Expand obstacles and corridor edges.

    Args:
        occupied: flat indices of occupied cells, shape (n,), as from `ObstacleMap.occupied`.
        count: cells a side.
        cell_m: edge of a cell, [m].
        layers: from the outermost boundary, SAFE, inwards.

    Raises:
        NavError: a radius that is negative or larger than 63 cells.

    Returns:
        Shape (count, count): how many boundaries a cell is inside of. It is inside one when its
        centre is not farther than the radius from the centre of an occupied cell.
    """
    widths = [_half_widths(layer.radius_m / cell_m) for layer in layers]
    pad = max(len(width) for width in widths)
    widened = _widened(_packed(occupied, count, pad), max(width[0] for width in widths))
    level = np.zeros((count, count), np.uint8)
    inner = np.zeros((count, count), np.uint8)
    for width, layer in zip(reversed(widths), reversed(layers), strict=True):
        inner |= _unpacked(_dilated(widened, width), count, pad)
        if layer.outside is not None:
            inner |= layer.outside.view(np.uint8)
        level += inner
    return level


@lru_cache(maxsize=32)
def _half_widths(radius: float) -> tuple[int, ...]:
    """Half the width of a disc in the rows 0, 1, 2, ... from its middle, all in cells."""
    if not 0 <= radius < _WORD:
        raise NavError(
            f"a boundary's radius is {radius:.1f} cells; must be within 0 and {_WORD - 1}"
        )
    squared = (
        radius * radius + 1e-9
    )  # a centre exactly on the rim is inside, whatever rounding says
    return tuple(int(np.sqrt(squared - row * row)) for row in range(int(np.sqrt(squared)) + 1))


def _row_words(count: int, pad: int) -> int:
    return -(-(count + 2 * pad) // _WORD)


def _packed(index: NDArray[np.int64], count: int, pad: int) -> _Words:
    """Cells as bits, shape (count, words a row); `pad` zeros on both sides keep rows apart."""
    bits = np.zeros((count, _row_words(count, pad) * _WORD), np.uint8)
    bits[index // count, index % count + pad] = 1
    return np.packbits(bits, axis=1, bitorder="little").view("<u8")


def _unpacked(words: _Words, count: int, pad: int) -> Cells:
    bits = np.unpackbits(words.view(np.uint8), axis=1, bitorder="little")
    return np.ascontiguousarray(bits[:, pad : pad + count])


def _widened(words: _Words, most: int) -> list[_Words]:
    """`words` with each bit spread over 0, 1, ... `most` cells to both sides."""
    spread = [words]
    for cells in range(1, most + 1):
        spread.append(_spread(spread[-1], words, cells))
    return spread


def _dilated(widened: list[_Words], half_widths: tuple[int, ...]) -> _Words:
    """The occupied cells dilated by a disc, row by row of it."""
    result = widened[half_widths[0]].copy()
    for row, width in enumerate(half_widths[1:], start=1):
        wide = widened[width]
        result[row:] |= wide[:-row]
        result[:-row] |= wide[row:]
    return result


def _spread(wide: _Words, words: _Words, cells: int) -> _Words:
    """`wide` and `words`, shifted by `cells` both ways."""
    shape, words = wide.shape, words.ravel()
    near, carry = np.uint64(cells), np.uint64(_WORD - cells)
    result = wide.ravel() | (words << near) | (words >> near)
    result[1:] |= words[:-1] >> carry
    result[:-1] |= words[1:] << carry
    return result.reshape(shape)
