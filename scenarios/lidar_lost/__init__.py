"""A scanner fails for good."""
