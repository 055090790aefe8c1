"""A check in words and numbers."""

from scenarios.truth import Check


def number(value: float) -> str:
    """With as many digits as matter."""
    return f"{value:.3g}" if abs(value) < 100.0 else f"{value:.0f}"


def row(name: str, check: Check) -> tuple[str, ...]:
    """Name, title, the twin's value, the range, the difference, and where the range is from."""
    low, high, reference = check.allowed
    unit = f" {check.unit}" if check.unit else ""
    known = "" if reference is None else f"{number(reference)}{unit}: "
    off = "" if check.off is None else f"{100.0 * check.off:+.1f} %"
    allowed = f"{known}{number(low)} to {number(high)}{unit}"
    return name, check.title, f"{number(check.twin)}{unit}", allowed, off, check.source
