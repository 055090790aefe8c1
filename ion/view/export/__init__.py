"""A drive as one file that plays in a browser, without a server."""
