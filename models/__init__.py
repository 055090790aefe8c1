"""MJCF of the vehicle, and the table of where each number comes from."""

from importlib import resources


def path() -> str:
    """The file of the vehicle's MJCF; works from a checkout and from an installed wheel."""
    return str(resources.files(__name__) / "polaris_ranger_6x6.xml")
