"""Every number of an episode that a scenario may set, by its name.

`world.friction`; all of the navigator's parameters as `navigator.speed.safe_distance_m`, after
their files; all of the sensors' as `sensors.lidar.noise_sd_m`; and what `ion compare` varies in the
middle of a drive: `judge.patience_s`, `drivetrain.shift_s`.
"""

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from difflib import get_close_matches
from typing import Any

import msgspec

from nav.parameters import ION, Parameters
from scenarios.course import Course
from scenarios.distribution import Number
from scenarios.episode import Episode
from scenarios.parameter_files import parameters_of
from scenarios.variation import JUDGE, SHIFT, apply
from scenarios.vehicles import VEHICLES

FRICTION = "world.friction"
NAVIGATOR, SENSORS = "navigator", "sensors"


def names(vehicle: str = ION) -> dict[str, Any]:
    """All names for a vehicle, and a value that each may have."""
    kind = VEHICLES[vehicle].kind
    sensors = dict(_leaves(kind.sensors(), SENSORS)) if kind else {}
    navigator = dict(_leaves(parameters_of(vehicle), NAVIGATOR))
    later: dict[str, Any] = dict.fromkeys(JUDGE, 1.0) | ({SHIFT: 1.0} if vehicle == ION else {})
    return {FRICTION: 0.8, **later, **navigator, **sensors}


def check(name: str, value: Number, vehicle: str = ION) -> None:
    """Refuse what cannot be set.

    Raises:
        ValueError: an unknown name, or a value of another kind.
    """
    known = names(vehicle)
    if name not in known:
        near = get_close_matches(name, known, 3, 0.4) or [FRICTION, *JUDGE]
        raise ValueError(f"cannot be set; there are {', '.join(near)}, and others")
    if not _like(value, known[name]):
        kind = type(known[name]).__name__
        raise ValueError(f"{value!r} is {type(value).__name__}, expected {kind}")


def begin(
    course: Course,
    seed: int,
    ablate: tuple[str, ...] = (),
    values: Mapping[str, Number] | None = None,
    parameters: Parameters | None = None,
) -> Episode:
    """An episode with other numbers: the navigator's instead of `parameters`, which are by default
    those that come with it.

    Raises:
        NavError: a route or parameters that the navigator refuses.
        ValueError: an unknown ablation.
    """
    values = values or {}
    told = {kind: _below(values, kind) for kind in (NAVIGATOR, SENSORS)}
    if FRICTION in values:
        course = replace(course, world=replace(course.world, friction=values[FRICTION]))
    navigator = _with(parameters or parameters_of(course.vehicle), told[NAVIGATOR])
    kind = VEHICLES[course.vehicle].kind
    changed = _with(kind.sensors(), told[SENSORS]) if kind and told[SENSORS] else None
    episode = Episode(course, seed, ablate, navigator, changed)
    apply(episode, {name: values[name] for name in (*JUDGE, SHIFT) if name in values})
    return episode


def _below(values: Mapping[str, Number], root: str) -> dict[str, Number]:
    return {k.partition(".")[2]: v for k, v in values.items() if k.partition(".")[0] == root}


def _leaves(value: Any, path: str) -> Iterator[tuple[str, Any]]:
    """All simple values below a table of parameters."""
    for name, inner in _items(value):
        if isinstance(inner, bool | int | float | str):
            yield f"{path}.{name}", inner
        else:
            yield from _leaves(inner, f"{path}.{name}")


def _items(value: Any) -> Iterator[tuple[str, Any]]:
    if is_dataclass(value):
        yield from ((f.name, getattr(value, f.name)) for f in fields(value))
    elif isinstance(value, msgspec.Struct):
        yield from ((name, getattr(value, name)) for name in value.__struct_fields__)
    elif isinstance(value, dict):
        yield from value.items()


def _with(value: Any, told: Mapping[str, Number]) -> Any:
    """A table of parameters, some of its values replaced by their dotted names."""
    for name, new in told.items():
        value = _replaced(value, name.split("."), new)
    return value


def _replaced(value: Any, path: list[str], new: Number) -> Any:
    key, *rest = path
    old = value[key] if isinstance(value, dict) else getattr(value, key)
    inner = _replaced(old, rest, new) if rest else type(old)(new)
    if isinstance(value, dict):
        return value | {key: inner}
    make: Any = msgspec.structs.replace if isinstance(value, msgspec.Struct) else replace
    return make(value, **{key: inner})


def _like(value: Number, known: Any) -> bool:
    whole_for_float = isinstance(known, float) and type(value) is int
    return whole_for_float or type(value) is type(known)
