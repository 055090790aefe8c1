"""The parameter files that come with the navigator: it reads no file itself, its callers do."""

from importlib.resources import files

from nav import parameters
from nav.parameters import ION


def parameter_texts(vehicle: str = ION) -> dict[str, str]:
    """Text of each file that describes a vehicle (`nav.parameters.files_of`), by name."""
    folder = files(parameters)
    names = parameters.files_of(vehicle)
    return {name: (folder / name).read_text(encoding="utf-8") for name in names}
