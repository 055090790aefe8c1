"""Any route definition file as a course."""

from scenarios.route.course import Surroundings, build

__all__ = ["Surroundings", "build"]
