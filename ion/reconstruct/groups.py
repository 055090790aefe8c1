"""Cells that belong together: each within reach of another of its group."""

import numpy as np

from ion.reconstruct.tally import Ints, cell_of

REACH = 2
"""Cells, along both axes: a gap of one cell is where no beam happened to end."""


def groups(cell: Ints) -> list[Ints]:
    """Which of the cells, shape (n,), make up each group; groups in the order of their first."""
    number = {c: k for k, c in enumerate(cell.tolist())}
    near = _near()
    found: list[Ints] = []
    while number:
        _, first = next(iter(number.items()))
        found.append(_grown(first, cell, number, near))
    return found


def _near() -> list[int]:
    steps = np.arange(-REACH, REACH + 1)
    return cell_of(steps[:, None], steps).ravel().tolist()


def _grown(first: int, cell: Ints, number: dict[int, int], near: list[int]) -> Ints:
    """The group of one cell; taken out of those that are left."""
    del number[int(cell[first])]
    group, due = [first], [int(cell[first])]
    while due:
        at = due.pop()
        for step in near:
            k = number.pop(at + step, None)
            if k is not None:
                group.append(k)
                due.append(at + step)
    return np.sort(np.array(group))
