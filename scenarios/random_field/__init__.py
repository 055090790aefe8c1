"""The random obstacle field of section 6.5 (Fig. 6.12), with the traps and forks of its failures."""

from scenarios.random_field.course import build

__all__ = ["build"]
