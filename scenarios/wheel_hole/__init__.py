"""A hole that holds a wheel until the throttle is opened."""
