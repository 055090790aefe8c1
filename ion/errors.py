"""What people do wrong at the command line."""


class UsageError(ValueError):
    """Bad input. The message is one line: what was wrong, where, what would have been right."""
