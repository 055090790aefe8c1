"""The Grand Challenge of 2005: 131.6 miles, 2,935 waypoints, from a plan of our own."""
