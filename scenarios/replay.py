"""Runs the present navigator again on what a tape's navigator was given.

A tick of the tape ends with the targets that the navigator gave; all messages before them were
delivered to it at their time. A last tick that was cut off is left out.
"""

from collections.abc import Iterator, Mapping
from os import PathLike
from types import MappingProxyType
from typing import NamedTuple

from nav.errors import NavError
from nav.messages import ActuatorTargets, Outputs, SensorMessage
from nav.navigator import IonNavigator
from nav.parameters import ION, files_of, parameters_from
from nav.route import rddf
from scenarios.processor import fingerprint
from tape.errors import TapeError
from tape.reader import attachments, metadata, read
from tape.record import Record

Path = str | PathLike[str]
SCENARIO = "scenario.toml"
NOTHING: Mapping[str, str] = MappingProxyType({})
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


def navigator_of(path: Path, instead: Mapping[str, str] = NOTHING) -> IonNavigator:
    """A navigator at its start, with the parameters, route and vehicle attached to a tape.

    Args:
        path: of the tape.
        instead: texts of parameter files that replace those of the same name.

    Raises:
        TapeError: no tape, or one that lacks them.
    """
    files = {name: data.decode() for name, data in attachments(path).items()} | {**instead}
    vehicle = metadata(path).get("vehicle", ION)
    try:
        route = _route_name(files, vehicle)
        return IonNavigator(parameters_from(files, vehicle), rddf.parse(files[route], route))
    except NavError as error:
        raise TapeError(f"{path}: its files do not make a navigator: {error}") from error


def route_of(path: Path) -> tuple[str, str]:
    """The route attached to a tape: its name and its text.

    Raises:
        TapeError: no tape, or none is attached.
    """
    files = {name: data.decode() for name, data in attachments(path).items()}
    try:
        name = _route_name(files, metadata(path).get("vehicle", ION))
    except NavError as error:
        raise TapeError(f"{path}: {error}") from error
    return name, files[name]


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


def unlike(path: Path) -> dict[str, tuple[str, str]]:
    """In what this machine is not the tape's, by the fingerprint: there and here; empty where
    equal."""
    said = metadata(path)
    both = {name: (said.get(name, ""), here) for name, here in fingerprint().items()}
    return {name: (there, here) for name, (there, here) in both.items() if there != here}


def tolerance(path: Path) -> float:
    """How much a number may differ: nothing, or a little on another kind of machine."""
    return ELSEWHERE if unlike(path) else 0.0
