"""A wall that only one scanner sees."""
