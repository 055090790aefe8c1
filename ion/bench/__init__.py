"""`ion bench`: what a simulated second costs, part by part, and against what others would take."""
