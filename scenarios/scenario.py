"""`scenario.toml`: what a scenario is called, its time limit, and the options that it takes."""

from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

import msgspec

FLAGS = {"first": "from", "last": "to"}
"""What an option is called on the command line, where that is no name in Python."""


class Option(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """What a value may be: one of some words, or a whole number within limits."""

    choices: tuple[str, ...] = ()
    least: int = 0
    most: int = 0

    def allows(self, value: object) -> bool:
        """Whether a value is one."""
        if self.choices:
            return value in self.choices
        return isinstance(value, int) and self.least <= value <= self.most

    def __str__(self) -> str:
        words = ", ".join(self.choices)
        return f"one of {words}" if words else f"a whole number from {self.least} to {self.most}"


class Scenario(msgspec.Struct, frozen=True):
    """What all files say; the rest of one is for the module that draws its course to check."""

    title: str
    course: str
    time_limit_s: float
    faults: list[str] = []
    """What fails, one line each; see `twin.faults.parse`."""
    options: dict[str, Option] = {}
    """By the names of `build`'s arguments beyond the seed."""


def scenario_names() -> list[str]:
    """All scenarios that can be driven by name: the folders that hold a `scenario.toml`."""
    folders = files("scenarios").iterdir()
    return sorted(f.name for f in folders if f.is_dir() and (f / "scenario.toml").is_file())


@cache
def load_scenario(name: str) -> Scenario:
    """The scenario of a folder."""
    text = (files("scenarios") / name / "scenario.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=Scenario)


def check_options(name: str, options: Mapping[str, Any]) -> None:
    """Refuse what a scenario does not take.

    Raises:
        ValueError: an option that it does not have, or a value that it does not allow.
    """
    known = load_scenario(name).options
    for option, value in options.items():
        flag = FLAGS.get(option, option)
        if option not in known:
            raise ValueError(f"--{flag}: the scenario {name!r} takes no such option")
        if not known[option].allows(value):
            raise ValueError(f"--{flag} {value}: expected {known[option]}")
