"""Brush across the corridor that a vehicle can drive through."""
