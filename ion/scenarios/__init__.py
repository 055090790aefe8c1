"""`ion scenarios`: which there are."""
