"""Any route definition file as a course."""

from scenarios.route.course import build

__all__ = ["build"]
