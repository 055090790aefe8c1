"""`ion falsify`: where a scenario fails, and the simplest case of it."""
