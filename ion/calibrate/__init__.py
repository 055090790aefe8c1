"""`ion calibrate`: the vehicle's parameters from a tape."""
