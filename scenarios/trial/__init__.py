"""Trials: short courses that put the navigator to one test each."""

from scenarios.trial.course import builder

__all__ = ["builder"]
