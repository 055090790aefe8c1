"""The small robot of Fig. 6.13: gates of two obstacles in a corridor, a third just behind each."""

from scenarios.small_robot.course import build

__all__ = ["build"]
