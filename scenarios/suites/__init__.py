"""Suites: scenarios, seeds and what is asked of them, as TOML files."""

from scenarios.suites.suite import Run, Suite, SuiteError, read_suite, suite_names

__all__ = ["Run", "Suite", "SuiteError", "read_suite", "suite_names"]
