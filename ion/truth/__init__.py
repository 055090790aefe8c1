"""How true the twin is, as one page."""
