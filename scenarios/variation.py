"""What may be varied in the middle of a drive: officials, gear linkage, states and watchdog."""

from collections.abc import Sequence
from dataclasses import fields, is_dataclass, replace
from itertools import product
from typing import Any, NamedTuple

from nav.parameters import Parameters
from scenarios.episode import Episode
from twin.linkage import GearboxParameters
from twin.plant import Plant

JUDGE = {"judge.patience_s": "seconds", "judge.patience_m": "metres"}
SHIFT = "drivetrain.shift_s"
POSITIONS = 3
"""Of the linkage, from H to R."""


class Vary(NamedTuple):
    """One name, and the values that it is to have."""

    name: str
    values: tuple[Any, ...]


def parse(text: str, parameters: Parameters) -> Vary:
    """`drivetrain.shift_s=1,10,60`.

    Raises:
        ValueError: unknown, or a value of the wrong kind; says what would be right.
    """
    name, equals, values = (part.strip() for part in text.partition("="))
    if not equals or not values:
        raise ValueError(f"{text!r}: expected NAME=VALUE,VALUE,...")
    known = names(parameters)
    if name not in known:
        raise ValueError(f"{name!r} cannot be varied; there are: {', '.join(known)}")
    vary = Vary(name, tuple(_value(name, w.strip(), known[name]) for w in values.split(",")))
    for value in vary.values if name not in (*JUDGE, SHIFT) else ():
        _with_state(parameters, name, value)  # refuses what it does not allow
    return vary


def names(parameters: Parameters) -> dict[str, Any]:
    """All names, and a value that each may have."""
    known: dict[str, Any] = {**dict.fromkeys(JUDGE, 0.0), SHIFT: 0.0}
    for table in fields(parameters.states):
        inner = getattr(parameters.states, table.name)
        if is_dataclass(inner):
            values = {f.name: getattr(inner, f.name) for f in fields(inner)}
            simple = {k: v for k, v in values.items() if isinstance(v, bool | int | float | str)}
            known |= {f"{table.name}.{key}": value for key, value in simple.items()}
    return known


def variants(varies: Sequence[Vary]) -> list[dict[str, Any]]:
    """Every combination, the first values first."""
    combined = product(*(vary.values for vary in varies))
    return [dict(zip((v.name for v in varies), values, strict=True)) for values in combined]


def apply(episode: Episode, variant: dict[str, Any]) -> None:
    """Let a drive go on with other values."""
    for name, value in variant.items():
        if name in JUDGE:
            patience = episode.judge.patience._replace(**{JUDGE[name]: value})
            episode.judge.patience, episode.judge.movement.place_m = patience, patience.metres
        elif name == SHIFT:
            plant = episode.simulator.plant  # pyright: ignore[reportAttributeAccessIssue]
            assert isinstance(plant, Plant)
            plant.gearbox.parameters = shifting_in(value)
        else:
            navigator = episode.navigator
            navigator.retune(_with_state(navigator.parameters, name, value))


def shifting_in(seconds: float) -> GearboxParameters:
    """A linkage that always takes so long from H to R, at the first try."""
    each = seconds / POSITIONS
    return GearboxParameters(each, 0.0, each, each, 0.0)


def _with_state(old: Parameters, name: str, value: Any) -> Parameters:
    table, key = name.split(".")
    inner = replace(getattr(old.states, table), **{key: value})
    return replace(old, states=replace(old.states, **{table: inner}))


def _value(name: str, word: str, like: Any) -> Any:
    if isinstance(like, bool):
        if word not in ("true", "false"):
            raise ValueError(f"{name}={word}: expected true or false")
        return word == "true"
    if isinstance(like, str):
        return word
    try:
        value = type(like)(word)
    except ValueError as error:
        kind = "a whole number" if isinstance(like, int) else "a number"
        raise ValueError(f"{name}={word}: expected {kind}") from error
    if not 0.0 <= value < float("inf"):
        raise ValueError(f"{name}={word}: expected 0 or more")
    return value
