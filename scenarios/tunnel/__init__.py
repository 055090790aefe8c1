"""A straight metal tunnel on the route line."""
