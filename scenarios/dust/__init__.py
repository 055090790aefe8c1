"""Dust across the corridor, and grass beside the track."""
