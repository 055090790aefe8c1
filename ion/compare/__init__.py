"""`ion compare`: the same drive, gone on with in several ways, and where these part."""
