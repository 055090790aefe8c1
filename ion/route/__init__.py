"""`ion route`: what a route file amounts to, in numbers and as a picture."""
