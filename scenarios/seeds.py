"""Lists of seeds, as people write them."""

import re

MAX_SEED = 2**32 - 1


def listed(text: str) -> list[int]:
    """The seeds of 7, 0-19 or 1,4,7-9, in order, each once.

    Raises:
        ValueError: it is no such list.
    """
    found: dict[int, None] = {}
    for part in text.split(","):
        match = re.fullmatch(r"\s*(\d{1,10})(?:-(\d{1,10}))?\s*", part)
        low, high = (int(match[1]), int(match[2] or match[1])) if match else (1, 0)
        if not low <= high <= MAX_SEED:
            raise ValueError(f"{part!r}: expected whole numbers such as 7, 0-19 or 1,4,7-9")
        found |= dict.fromkeys(range(low, high + 1))
    return list(found)
