"""Runs the present navigator again on what a tape's navigator was given, and compares.

A tick of the tape ends with the targets that the navigator gave; all messages before them were
delivered to it at their time. A last tick that was cut off is left out.
"""

from collections.abc import Iterator, Sequence
from dataclasses import fields
from os import PathLike
from typing import Any, NamedTuple

import numpy as np

from nav.errors import NavError
from nav.messages import ActuatorTargets, Message, Outputs, SensorMessage
from nav.navigator import IonNavigator
from nav.parameters import ION, files_of, parameters_from
from nav.route import rddf
from scenarios.processor import fingerprint
from tape.codec import encode
from tape.errors import TapeError
from tape.reader import attachments, metadata, read
from tape.record import Record

Path = str | PathLike[str]
SCENARIO = "scenario.toml"
ELSEWHERE = 1e-9
"""On another processor or with other versions, last bits differ: numbers are compared to this."""


class Tick(NamedTuple):
    """One call of the navigator."""

    time_ns: int
    messages: tuple[SensorMessage, ...]
    """What was delivered, in order."""
    outputs: Outputs
    """What the present navigator made of it."""
    logged: tuple[Record, ...]
    """What the tape says that the navigator then made of it: reports, then targets."""


def navigator_of(path: Path) -> IonNavigator:
    """A navigator at its start, with the parameters, route and vehicle attached to a tape.

    Raises:
        TapeError: no tape, or one that lacks them.
    """
    files = {name: data.decode() for name, data in attachments(path).items()}
    vehicle = metadata(path).get("vehicle", ION)
    try:
        route = _route_name(files, vehicle)
        return IonNavigator(parameters_from(files, vehicle), rddf.parse(files[route], route))
    except NavError as error:
        raise TapeError(f"{path}: its attachments do not make a navigator: {error}") from error


def _route_name(files: dict[str, str], vehicle: str) -> str:
    """The route is attached under its own name: the first that is not known otherwise."""
    others = [name for name in files if name not in (*files_of(vehicle), SCENARIO)]
    if not others:
        raise NavError("no route is among them")
    return others[0]


def replay(path: Path, navigator: IonNavigator) -> Iterator[Tick]:
    """Drive a navigator through a tape.

    Args:
        path: of the tape.
        navigator: of `navigator_of`; after each tick it is as it was then.

    Raises:
        TapeError: as `tape.reader.read`.
    """
    sensed: list[SensorMessage] = []
    logged: list[Record] = []
    for item in read(path):
        if isinstance(item.message, SensorMessage):
            sensed.append(item.message)
            continue
        logged.append(item)
        if isinstance(item.message, ActuatorTargets):
            outputs = navigator.step(item.delivery_ns, sensed)
            yield Tick(item.delivery_ns, tuple(sensed), outputs, tuple(logged))
            sensed, logged = [], []


def tolerance(path: Path) -> float:
    """How much a number may differ: nothing, or a little on another kind of machine."""
    said = metadata(path)
    here = all(said.get(name) == value for name, value in fingerprint().items())
    return 0.0 if here else ELSEWHERE


def difference(tick: Tick, tolerance: float = 0.0) -> str:
    """What the replay says otherwise than the tape, the first of it; empty where nothing."""
    ours: Sequence[Message] = (*tick.outputs.reports, tick.outputs.targets)
    kinds = [[type(m).__name__ for m in ms] for ms in (ours, [r.message for r in tick.logged])]
    if kinds[0] != kinds[1]:
        return f"the tape has {', '.join(kinds[1])}, the replay {', '.join(kinds[0])}"
    for message, item in zip(ours, tick.logged, strict=True):
        if encode(message) != item.payload and (found := _field(message, item, tolerance)):
            return found
    return ""


def _field(ours: Any, logged: Record, tolerance: float) -> str:
    """The first field that differs by more."""
    for name in (field.name for field in fields(ours)):
        here, there = getattr(ours, name), getattr(logged.message, name)
        if not _alike(here, there, tolerance):
            return f"{type(ours).__name__}.{name} is {there} on the tape, {here} in the replay"
    return "" if tolerance else f"{type(ours).__name__} has other bits: a negative zero?"


def _alike(a: Any, b: Any, tolerance: float) -> bool:
    if isinstance(a, float | np.ndarray) and np.shape(a) == np.shape(b):
        return bool(np.allclose(a, b, tolerance, tolerance, equal_nan=True))
    return not isinstance(a, float | np.ndarray) and a == b
