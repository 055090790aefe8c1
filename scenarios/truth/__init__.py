"""The twin held against measurements and published numbers, one check each: `ion truth`."""

from scenarios.truth.check import Check, Curve
from scenarios.truth.registry import CHECKS

__all__ = ["CHECKS", "Check", "Curve"]
