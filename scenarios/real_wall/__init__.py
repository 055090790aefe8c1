"""A wall across the corridor."""
