"""MJCF of the vehicles, and the table of where each number comes from."""

from importlib import resources

RANGER, PIONEER = "polaris_ranger_6x6", "pioneer_p3at"


def path(model: str = RANGER) -> str:
    """The file of a vehicle's MJCF; works from a checkout and from an installed wheel."""
    return str(resources.files(__name__) / f"{model}.xml")
