"""The root of every error that the tape raises."""


class TapeError(ValueError):
    """A tape that cannot be written or read; says what, where, and what would be right."""


class CodecError(TapeError):
    """A message that would not survive the tape bit for bit, or bytes that are no message."""
