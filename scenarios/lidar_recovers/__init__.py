"""A scanner fails and comes back when it is reset."""
