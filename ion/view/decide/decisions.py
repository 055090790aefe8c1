"""Any decision of a tape, found again by replaying the navigator from a snapshot near it."""

import pickle
import zlib
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, get_args

from ion.explain.asked import Answer
from ion.explain.explanation import Explanation, explanation_of
from ion.explain.numbers import Numbers, numbers
from nav.messages import ActuatorTargets, Decision, SensorMessage
from nav.navigator import HIGH_LEVEL_EVERY, IonNavigator
from nav.parameters import ION, parameters_from
from scenarios.replay import navigator_of
from tape.reader import Packed, attachments, metadata, read_packed

EVERY = 200
"""Calls of the navigator from one snapshot to the next: 4 s, replayed in a tenth of one."""
SENSED = frozenset(get_args(SensorMessage))


class Tick(NamedTuple):
    """One call of the navigator, as the tape has it."""

    time_ns: int
    sensed: tuple[Packed, ...]
    decided: Packed | None


class Decisions:
    """The decisions of one tape.

    Args:
        log: the tape; read through once.

    Raises:
        TapeError: no tape, or one that does not make a navigator.
    """

    def __init__(self, log: Path) -> None:
        said = metadata(log)
        self._vehicle = said.get("vehicle", ION)
        self._files = {name: data.decode() for name, data in attachments(log).items()}
        self._ticks = list(_ticks(log))
        self._time_s = [tick.time_ns * 1e-9 for tick in self._ticks]
        self._navigator = navigator_of(log)
        self._packed = [_pack(self._navigator)]
        self._reached = 0
        self._before: tuple[int, bytes] = (-1, b"")

    @property
    def reached_s(self) -> float:
        """Until when decisions can be asked for."""
        return self._time_s[self._reached - 1] if self._reached else 0.0

    def advance(self, calls: int) -> bool:
        """Replay a little more of the tape; False at its end."""
        for tick in self._ticks[self._reached : self._reached + calls]:
            _step(self._navigator, tick)
            self._reached += 1
            if self._reached % EVERY == 0:
                self._packed.append(_pack(self._navigator))
        return self._reached < len(self._ticks)

    def at(self, time_s: float, instead: Mapping[str, str]) -> "Found | None":
        """The last decision until a time, and what it would be with other parameter files.

        Raises:
            NavError: files that do not make a navigator.
        """
        index = bisect_right(self._time_s, time_s + 1e-6)
        call = index // HIGH_LEVEL_EVERY * HIGH_LEVEL_EVERY - 1  # the last one that decided
        if call < 0:
            return None
        before, tick = self._state_before(call), self._ticks[call]
        was = _explained(pickle.loads(before), tick)
        if was is None:
            return None
        would = self._would(before, tick, instead) if instead else None
        return Found(_numbers(was), would and _numbers(would), _same(was, tick))

    def _would(self, before: bytes, tick: Tick, instead: Mapping[str, str]) -> Explanation | None:
        p = parameters_from(self._files | {**instead}, self._vehicle)
        navigator: IonNavigator = pickle.loads(before)
        navigator.retune(replace(navigator.parameters, steering=p.steering, speed=p.speed))
        return _explained(navigator, tick)

    def _state_before(self, call: int) -> bytes:
        """The navigator when a call began, packed; that of the last question is at hand."""
        if self._before[0] != call:
            k = min(call // EVERY, len(self._packed) - 1)
            navigator = pickle.loads(zlib.decompress(self._packed[k]))
            for tick in self._ticks[k * EVERY : call]:
                _step(navigator, tick)
            self._before = (call, pickle.dumps(navigator))
        return self._before[1]


class Found(NamedTuple):
    """One decision, as `ion explain --json` gives it."""

    was: Numbers
    would: Numbers | None
    """With other parameter files, where there are some."""
    same: bool
    """Whether the replay decided what the tape says."""


def _ticks(log: Path) -> Iterator[Tick]:
    sensed: list[Packed] = []
    decided: Packed | None = None
    for item in read_packed(log):
        if item.kind in SENSED:
            sensed.append(item)
        elif item.kind is Decision:
            decided = item
        elif item.kind is ActuatorTargets:
            yield Tick(item.delivery_ns, tuple(sensed), decided)
            sensed, decided = [], None


def _step(navigator: IonNavigator, tick: Tick) -> None:
    navigator.step(tick.time_ns, [_sensed(item) for item in tick.sensed])


def _sensed(item: Packed) -> Any:
    return item.message()


def _pack(navigator: IonNavigator) -> bytes:
    return zlib.compress(pickle.dumps(navigator), 1)


def _explained(navigator: IonNavigator, tick: Tick) -> Explanation | None:
    _step(navigator, tick)
    return explanation_of(navigator)


def _numbers(why: Explanation) -> Numbers:
    return numbers(Answer(why, "", ""))


def _same(why: Explanation, tick: Tick) -> bool:
    """Compared by what is decided: direction and speed."""
    decided = tick.decided and tick.decided.message()
    if not isinstance(decided, Decision):
        return False
    return (decided.decision_rad, decided.speed_mps) == (why.plan.decision_rad, why.plan.speed_mps)
