"""All parameters of the navigator: one TOML file a table, each into frozen dataclasses.

The files are ION's. Another vehicle is one more file, which says only what it has otherwise, under
the names of these files.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, get_type_hints

from nav.parameters.control import ControlParameters
from nav.parameters.ego_state import EgoParameters
from nav.parameters.fuzzy import SpeedParameters, SteeringParameters
from nav.parameters.loader import ParameterError, from_table, from_toml, merged, table_of
from nav.parameters.obstacle_map import ObstacleMapParameters
from nav.parameters.planning import PlanningParameters
from nav.parameters.plausibility import PlausibilityParameters
from nav.parameters.states import StateParameters
from nav.parameters.vehicle import VehicleParameters

__all__ = ["FILES", "ION", "ParameterError", "Parameters", "files_of", "parameters_from"]

ION = "ion"
"""The vehicle that the files themselves describe."""


@dataclass(frozen=True)
class Parameters:
    """Each field is one file of the same name, `.toml`."""

    vehicle: VehicleParameters
    ego_state: EgoParameters
    plausibility: PlausibilityParameters
    obstacle_map: ObstacleMapParameters
    planning: PlanningParameters
    steering: SteeringParameters
    speed: SpeedParameters
    states: StateParameters
    control: ControlParameters


_TABLES: dict[str, Any] = get_type_hints(Parameters)
FILES = tuple(f"{name}.toml" for name in _TABLES)
"""The files that describe ION, in this package; callers read and record them."""


def parameters_from(texts: Mapping[str, str], vehicle: str = ION) -> Parameters:
    """Build all parameters from the texts of `FILES`, and of a vehicle's own file.

    Raises:
        ParameterError: a file is missing, or says something that is unknown or wrong.
    """
    needed = files_of(vehicle)
    if missing := [name for name in needed if name not in texts]:
        raise ParameterError(f"{missing[0]}: missing; a full set is {', '.join(needed)}")
    over = {} if vehicle == ION else table_of(texts[f"{vehicle}.toml"], f"{vehicle}.toml")
    if unknown := [name for name in over if name not in _TABLES]:
        known = ", ".join(_TABLES)
        raise ParameterError(f"{vehicle}.toml: {unknown[0]}: unknown table; known are {known}")
    built = {
        name: from_toml(cls, texts[f"{name}.toml"], f"{name}.toml") for name, cls in _TABLES.items()
    }
    for name, instead in over.items():
        table = merged(_TABLES[name], table_of(texts[f"{name}.toml"], name), instead)
        built[name] = from_table(_TABLES[name], table, f"{vehicle}.toml: {name}")
    return Parameters(**built)


def files_of(vehicle: str) -> tuple[str, ...]:
    """The files that say all about a vehicle."""
    return FILES if vehicle == ION else (*FILES, f"{vehicle}.toml")
