"""The random obstacle field of section 6.5 (Fig. 6.12); traps and forks, where it failed."""

from scenarios.random_field.course import build

__all__ = ["build"]
