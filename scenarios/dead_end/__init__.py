"""A dead end on the way, and another path beside it."""
