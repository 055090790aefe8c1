"""Seeds as people write them."""

from ion.errors import UsageError
from scenarios import seeds


def listed(text: str, what: str) -> list[int]:
    """A list of seeds as people write it: 7, 0-19 or 1,4,7-9.

    Raises:
        UsageError: it is none.
    """
    try:
        return seeds.listed(text)
    except ValueError as error:
        raise UsageError(f"{what} {error}") from error
