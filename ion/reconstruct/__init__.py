"""`ion reconstruct`: a scenario from a tape: its route, obstacles as they were seen, faults."""
