"""Faults as the messages of a device show them: silence, repetition, lateness, flapping.

What cannot be told from messages alone, noise and offsets, is no business of this file.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import NDArray

from ion.reconstruct.stream import Stream
from twin.faults import Fault

SILENT_S, SILENT_PERIODS = 0.3, 3.5
"""A gap of both is a silence: single messages are lost on any wire."""
FROZEN_S = 0.5
"""So long a device must repeat itself."""
LATE_S = 0.2
"""Later than usual by this is late."""
USUAL = 5.0
"""Percentile of the delays that is the usual one: most of a tape may be late."""
FLAPS = 3
"""Silences in a row ..."""
ALIKE = 0.15
"""... of which each begins and ends so nearly when the period says, as a share of it."""


def failures(device: str, heard: Stream, resets_s: Sequence[float], end_s: float) -> list[Fault]:
    """All that can be told of a device, in the order of time.

    Args:
        device: its name.
        heard: its messages.
        resets_s: when the navigator reset it, ascending.
        end_s: of the tape. What lasts until then has no end.
    """
    if not len(heard.measured_s):
        return [Fault(device, "silent", 0.0)]
    flaps, gaps = flapping(device, silences(device, heard, end_s))
    lasting = [*gaps, *frozen(device, heard), *late(device, heard)]
    found = [*flaps, *(recovering(fault, resets_s) for fault in lasting)]
    return sorted(found, key=lambda fault: fault.begins)


def silences(device: str, heard: Stream, end_s: float) -> list[Fault]:
    """Stretches without a measurement, those at the start and the end of the tape included."""
    longest = max(SILENT_S, SILENT_PERIODS * heard.period_s)
    at_s = np.concatenate([[0.0], heard.measured_s])
    found = [
        _fault(device, "silent", float(at_s[k]), float(at_s[k + 1]), heard)
        for k in np.flatnonzero(np.diff(at_s) > longest).tolist()
    ]
    if end_s - float(heard.delivered_s.max()) > longest:
        found.append(_fault(device, "silent", float(at_s[-1]), inf, heard))
    return found


def frozen(device: str, heard: Stream) -> list[Fault]:
    """Stretches in which a device repeats itself; the first message of each was still true."""
    found: list[Fault] = []
    for first, behind in _runs(heard.repeats):
        began, ended = _before(heard, first), _after(heard, behind)
        if heard.measured_s[behind - 1] - began >= FROZEN_S:
            found.append(_fault(device, "frozen", began, ended, heard))
    return found


def late(device: str, heard: Stream) -> list[Fault]:
    """Stretches in which messages arrive later than usual, with how much later."""
    delay_s = heard.delivered_s - heard.measured_s
    delay_s = delay_s - np.percentile(delay_s, USUAL)
    return [
        replace(
            _fault(device, "late", _before(heard, first), _after(heard, behind), heard),
            size=round(float(np.median(delay_s[first:behind])), 2),
        )
        for first, behind in _runs(delay_s > LATE_S)
    ]


def flapping(device: str, gaps: list[Fault]) -> tuple[list[Fault], list[Fault]]:
    """Silences that come and go with a period, as one fault each; and the other silences."""
    flaps: list[Fault] = []
    left: list[Fault] = []
    due = list(gaps)
    while due:
        row = _row(due)
        if len(row) < FLAPS:
            left.append(due.pop(0))
            continue
        flaps.append(_flapping(device, row))
        due = due[len(row) :]
    return flaps, left


def recovering(fault: Fault, resets_s: Sequence[float]) -> Fault:
    """The same, ended by the reset that came before its end, where there was one."""
    resets = [at_s for at_s in resets_s if fault.begins <= at_s < fault.ends]
    if fault.ends == inf or not resets:
        return fault
    return replace(fault, ends=inf, recovers_s=round(fault.ends - resets[0], 2))


def _row(gaps: Sequence[Fault]) -> Sequence[Fault]:
    """The silences from the first on that keep to one period. The first may be cut short, as the
    fault began in the midst of it, and the last, as the fault or the tape ended."""
    if len(gaps) < FLAPS:
        return ()
    period_s = gaps[2].begins - gaps[1].begins
    row = 1
    for one, other in pairwise(gaps):
        if not _begins_on_time(one, other, period_s):
            break
        row += 1
        if not _is_half(other, period_s):
            break
    return gaps[:row]


def _begins_on_time(one: Fault, other: Fault, period_s: float) -> bool:
    """Whether half a period of messages lies between two silences."""
    return abs(other.begins - one.ends - 0.5 * period_s) < ALIKE * period_s


def _is_half(gap: Fault, period_s: float) -> bool:
    """Whether a silence lasts half a period."""
    return abs(gap.ends - gap.begins - 0.5 * period_s) < ALIKE * period_s


def _flapping(device: str, row: Sequence[Fault]) -> Fault:
    starts = np.array([gap.begins for gap in row[1:]])
    period_s = round(float(np.median(np.diff(starts))), 2)
    return Fault(device, "flapping", row[0].begins, row[-1].ends, size=period_s)


def _fault(device: str, kind: str, last_s: float, next_s: float, heard: Stream) -> Fault:
    """It began between the last good message and the one due then, and ended likewise."""
    half_s = 0.5 * heard.period_s
    begins = round(last_s + half_s, 2) if last_s > 0.0 else 0.0
    return Fault(device, kind, begins, next_s if next_s == inf else round(next_s - half_s, 2))


def _before(heard: Stream, first: int) -> float:
    """When the message before the first was measured, [s]."""
    return float(heard.measured_s[first - 1]) if first else 0.0


def _after(heard: Stream, behind: int) -> float:
    """When the message behind the last was measured; infinite where there is none."""
    return float(heard.measured_s[behind]) if behind < len(heard.measured_s) else inf


def _runs(holds: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Where something holds: first index and the one behind the last, of each run."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], holds, [False]]).astype(np.int8)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))
