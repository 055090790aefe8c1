"""A case that fails, as a scenario file that one can drive, and a suite can hold."""

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from ion.falsify.shrink import Shrunk
from scenarios.bounds import Expected
from scenarios.scenario_file import ARRIVED, ScenarioFile

SEVERAL = (list, tuple)


def write(folder: Path, table: Mapping[str, Any], small: Shrunk, how: Sequence[str]) -> Path:
    """Write what the search's scenario has become, and the route file that it may need.

    Args:
        folder: where.
        table: what the file of the search's scenario says.
        small: the case.
        how: lines that say how it was found.
    """
    scenario = small.episode.point.scenario
    if scenario.route:
        (folder / Path(scenario.route).name).write_text(scenario.route_text, encoding="utf-8")
    path = folder / f"{scenario.name}_{small.figure.replace('.', '_')}.toml"
    lines = [f"# {line}" for line in (*how, *seeds_said(small), *in_a_suite(path, small))]
    lines += toml(failing_table(table, scenario, small.figure))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def seeds_said(small: Shrunk) -> list[str]:
    """Whether the seed matters, for people: a scenario file holds none."""
    seed, tried, failing = small.episode.point.seed, small.other_seeds, small.failing_seeds
    if not tried:
        return [f"It fails with seed {seed}; no other was tried."]
    return [f"It fails with seed {seed}, and with {failing} of {tried} other seeds."]


def in_a_suite(path: Path, small: Shrunk) -> list[str]:
    """How it is driven again."""
    seed = small.episode.point.seed
    return [
        f"ion drive {path.name} --seed {seed}",
        f'In a suite: [[run]], scenario = "{path.name}", seeds = "{seed}"',
    ]


def failing_table(table: Mapping[str, Any], scenario: ScenarioFile, figure: str) -> dict[str, Any]:
    """What the file says: only what is needed, and only the verdict that fails."""
    title = f"{scenario.title.rstrip('.')}: here {figure} fails."
    said = {**table, "title": title, "faults": scenario.faults, "ablate": scenario.ablate}
    said |= {"route": Path(scenario.route).name} if scenario.route else {}
    said |= {"vary": scenario.vary, "verdicts": {figure: _expected(scenario, figure)}}
    return {key: value for key, value in said.items() if value not in ((), {})}


def _expected(scenario: ScenarioFile, figure: str) -> Any:
    """The bound without what it does not say."""
    expected: Expected = (scenario.verdicts or ARRIVED)[figure]
    plain = msgspec.to_builtins(expected)
    if not isinstance(plain, dict):
        return plain
    return {key: value for key, value in plain.items() if value not in (None, (), [])}


def toml(table: Mapping[str, Any]) -> Iterator[str]:
    """Lines of TOML; tables in tables stand in one line."""
    for key, value in table.items():
        if not isinstance(value, Mapping):
            yield f"{_key(key)} = {_outer(value)}"
    for key, value in table.items():
        if isinstance(value, Mapping):
            yield f"\n[{_key(key)}]"
            yield from (f"{_key(k)} = {_inline(v)}" for k, v in value.items())


def _outer(value: Any) -> str:
    """A list of tables or lists has a line for each."""
    if isinstance(value, SEVERAL) and any(isinstance(v, (Mapping, *SEVERAL)) for v in value):
        return "[\n" + "".join(f"    {_inline(v)},\n" for v in value) + "]"
    return _inline(value)


def _inline(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_inline(v)}" for k, v in value.items()) + " }"
    if isinstance(value, SEVERAL):
        return "[" + ", ".join(map(_inline, value)) + "]"
    return repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False)


def _key(key: str) -> str:
    return key if key.replace("_", "").isalnum() else json.dumps(key)
