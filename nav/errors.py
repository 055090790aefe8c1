"""The root of every error that the navigator raises."""


class NavError(ValueError):
    """Bad input. The message says what was wrong, where, and what would have been right."""
