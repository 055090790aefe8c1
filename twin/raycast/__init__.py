"""Rays against the ground and the things that stand on it, shared by LIDAR, sonar and GPS sky."""

from twin.raycast.geometry import GROUND, NO_HIT
from twin.raycast.scene import Scene, cast, cast_hits, hide

__all__ = ["GROUND", "NO_HIT", "Scene", "cast", "cast_hits", "hide"]
