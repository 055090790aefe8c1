"""The National Qualification Event of 2005."""

from scenarios.nqe.course import build

__all__ = ["build"]
