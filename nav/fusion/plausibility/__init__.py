"""Whether what a sensor says can be true: by itself, and beside what the others say."""

from nav.fusion.plausibility.monitor import Plausibility

__all__ = ["Plausibility"]
