"""Membership functions that can be turned while one looks at what they decide."""
