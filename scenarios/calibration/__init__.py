"""A fixed manoeuvre on level ground, and the vehicle's parameters found from the tape of it."""
