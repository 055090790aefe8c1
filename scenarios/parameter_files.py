"""The parameter files that come with the navigator: it reads no file itself, its callers do."""

from functools import cache
from importlib.resources import files

from nav import parameters
from nav.parameters import ION, Parameters


def parameter_texts(vehicle: str = ION) -> dict[str, str]:
    """Text of each file that describes a vehicle (`nav.parameters.files_of`), by name."""
    folder = files(parameters)
    names = parameters.files_of(vehicle)
    return {name: (folder / name).read_text(encoding="utf-8") for name in names}


@cache
def parameters_of(vehicle: str = ION) -> Parameters:
    """The parameters of a vehicle as they come with the navigator; they cannot be changed, so all
    episodes of a process share them."""
    return parameters.parameters_from(parameter_texts(vehicle), vehicle)
