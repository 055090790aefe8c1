"""The parameter files that come with the navigator: it reads no file itself, its callers do."""

from importlib.resources import files

from nav import parameters


def parameter_texts() -> dict[str, str]:
    """Text of each of `nav.parameters.FILES`, by name."""
    folder = files(parameters)
    return {name: (folder / name).read_text(encoding="utf-8") for name in parameters.FILES}
