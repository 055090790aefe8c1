"""`ion drive`: a course, from its start to its end, once or with many seeds."""
