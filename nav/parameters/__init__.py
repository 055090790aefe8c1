"""All parameters of the navigator: one TOML file a table, each into frozen dataclasses."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, get_type_hints

from nav.parameters.control import ControlParameters
from nav.parameters.ego_state import EgoParameters
from nav.parameters.fuzzy import SpeedParameters, SteeringParameters
from nav.parameters.loader import ParameterError, from_toml
from nav.parameters.obstacle_map import ObstacleMapParameters
from nav.parameters.planning import PlanningParameters
from nav.parameters.states import StateParameters
from nav.parameters.vehicle import VehicleParameters

__all__ = ["FILES", "ParameterError", "Parameters", "parameters_from"]


@dataclass(frozen=True)
class Parameters:
    """Each field is one file of the same name, `.toml`."""

    vehicle: VehicleParameters
    ego_state: EgoParameters
    obstacle_map: ObstacleMapParameters
    planning: PlanningParameters
    steering: SteeringParameters
    speed: SpeedParameters
    states: StateParameters
    control: ControlParameters


_TABLES: dict[str, Any] = get_type_hints(Parameters)
FILES = tuple(f"{name}.toml" for name in _TABLES)
"""The files that make up a set of parameters, in this package; callers read and record them."""


def parameters_from(texts: Mapping[str, str]) -> Parameters:
    """Build all parameters from the texts of `FILES`.

    Raises:
        ParameterError: a file is missing, or says something that is unknown or wrong.
    """
    if missing := [name for name in FILES if name not in texts]:
        raise ParameterError(f"{missing[0]}: missing; a full set is {', '.join(FILES)}")
    return Parameters(
        **{
            name: from_toml(cls, texts[f"{name}.toml"], f"{name}.toml")
            for name, cls in _TABLES.items()
        }
    )
