"""Draws it from `scenario.toml`."""

from scenarios.trial import builder

build = builder(__package__ or "")
