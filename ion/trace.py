"""What a run leaves for its map: where the vehicle was, and which obstacles it saw."""

from array import array
from collections.abc import Sequence
from typing import TYPE_CHECKING
from zlib import compress, decompress

import numpy as np
from numpy.typing import NDArray

from nav.messages import ObstacleCells
from tape.record import Record

if TYPE_CHECKING:
    from scenarios.episode import Episode

Floats = NDArray[np.float64]
Cells = NDArray[np.int32]

NO_CELLS: Cells = np.zeros((0, 2), np.int32)
EVERY = 10
"""Ticks between two places: 0.2 s."""
MERGED = 200
"""Reports of cells that are kept side by side before those that repeat are dropped."""
MOST = 20_000
"""Cells among which they are looked for: those of the last half mile, or so. What lies farther back
is let be, so that the last mile costs no more than the first."""


class Trace:
    """Watches a run, in memory that grows with the way and not with the time."""

    def __init__(self) -> None:
        self._tick = 0
        self._places = array("d")
        self._past: list[bytes] = []
        """Packed: a quarter, as measured in a race."""
        self._recent = NO_CELLS
        self._new: list[Cells] = []
        self._cell_m = 1.0

    def __call__(self, episode: "Episode", records: Sequence[Record]) -> None:
        """Take the truth every 0.2 s, and all cells that were reported."""
        if self._tick % EVERY == 0 or episode.outcome:
            x, y = episode.truth.position_m[:2].tolist()
            self._places.extend((x, y, episode.truth.speed_mps))
        self._tick += 1
        self._cell_m = episode.navigator.parameters.obstacle_map.cell_m
        for record in records:
            if isinstance(record.message, ObstacleCells):
                cells = np.floor(record.message.position_m / self._cell_m).astype(np.int32)
                self._new.append(cells.reshape(-1, 2))
        if len(self._new) >= MERGED:
            self._merge()

    def track(self) -> Floats:
        """Shape (n, 3): x, y [m] in the world frame and speed [m/s]."""
        return np.array(self._places).reshape(-1, 3)

    def cells_m(self) -> Floats:
        """Shape (m, 2): all cells that were ever occupied, route frame N, [m]."""
        self._merge()
        past = [np.frombuffer(decompress(part), np.int32).reshape(-1, 2) for part in self._past]
        cells = np.unique(np.concatenate([*past, self._recent]), axis=0)
        return (cells.astype(np.float64) + 0.5) * self._cell_m

    def _merge(self) -> None:
        self._recent = np.unique(np.concatenate([self._recent, *self._new]), axis=0)
        self._new = []
        if len(self._recent) > MOST:
            self._past.append(compress(self._recent.tobytes(), 1))
            self._recent = NO_CELLS
