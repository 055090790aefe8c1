"""What a drive leaves for its map."""

from types import SimpleNamespace
from typing import cast

import numpy as np

from ion import trace
from ion.trace import Trace
from nav.messages import ObstacleCells
from scenarios.episode import Episode
from tape.record import Record, record

CELL_M = 0.2
EPISODE = SimpleNamespace(
    truth=SimpleNamespace(position_m=np.zeros(3), speed_mps=0.0),
    outcome=None,
    navigator=SimpleNamespace(
        parameters=SimpleNamespace(obstacle_map=SimpleNamespace(cell_m=CELL_M))
    ),
)


def seen(position_m) -> list[Record]:
    """A tick in which cells were reported."""
    cells = ObstacleCells(0, position_m, np.ones(len(position_m)))
    return [record(0, cells)]


def test_each_cell_is_kept_once_however_far_the_way(monkeypatch):
    monkeypatch.setattr(trace, "MERGED", 3)
    monkeypatch.setattr(trace, "MOST", 50)
    left, along = Trace(), np.arange(40) * CELL_M
    for k in range(100):
        ahead = np.column_stack([along + (k // 2) * CELL_M, np.zeros(40)]) + 0.5 * CELL_M
        left(cast(Episode, EPISODE), seen(ahead))
    assert len(left._past) > 1
    assert np.allclose(left.cells_m()[:, 0], (np.arange(89) + 0.5) * CELL_M)
