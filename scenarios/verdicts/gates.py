"""Gates: passed when the outline goes through the opening forwards, in order, untouched.

A touch needs no care here: gates are measured between the inner faces of their posts, and the
first contact ends an episode.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from scenarios.course import Gate
from scenarios.verdicts.shapes import Outline, Pose

NEAR_M = 15.0
"""Gates farther from the reference point than this, along x or y, are not looked at."""
LISTED_M = 20.0
"""Those nearer than this are listed; the list is made anew where the vehicle has gone on by the
difference."""


class _Line(NamedTuple):
    """A gate's own frame: x forwards through the middle of the opening, y to the left post."""

    x: float
    y: float
    cos: float
    sin: float
    half_width_m: float

    def local(self, x: float, y: float) -> tuple[float, float]:
        dx, dy = x - self.x, y - self.y
        return self.cos * dx + self.sin * dy, self.cos * dy - self.sin * dx


@dataclass
class GateKeeper:
    """Follows the outline through one gate after the other."""

    gates: Sequence[Gate]
    outline: Outline
    passed: list[int] = field(default_factory=list)
    """Indices, in the order of passing."""
    _next: int = 0
    _before: set[int] = field(default_factory=set)
    """Gates that the outline stood wholly before, and has not gone around since."""

    def __post_init__(self) -> None:
        self._lines = [_line(gate) for gate in self.gates]
        self._listed: list[int] = []
        self._listed_at: Pose = (math.inf, math.inf, 0.0)

    def observe(self, pose: Pose) -> None:
        """Take the pose of the reference point."""
        if not _is_near(self._listed_at, pose, LISTED_M - NEAR_M):
            self._listed = [k for k, at in enumerate(self._lines) if _is_near(at, pose, LISTED_M)]
            self._listed_at = pose
        near = [
            k for k in self._listed if k >= self._next and _is_near(self._lines[k], pose, NEAR_M)
        ]
        if near:
            corners = self.outline.corners_m(pose)
            for k in near:
                self._follow(k, [self._lines[k].local(x, y) for x, y in corners])

    def missed(self, all_behind: bool) -> list[int]:
        """Gates behind the vehicle that it did not pass."""
        behind = len(self.gates) if all_behind else self._next
        return [k for k in range(behind) if k not in self.passed]

    def _follow(self, k: int, corners: list[tuple[float, float]]) -> None:
        """Take the outline's corners in the frame of gate k."""
        if max(x for x, _ in corners) <= 0.0:
            self._before.add(k)
        elif min(x for x, _ in corners) < 0.0:
            if any(abs(y) > self._lines[k].half_width_m for y in _crossings(corners)):
                self._before.discard(k)
        elif k in self._before and k >= self._next:
            self.passed.append(k)
            self._next = k + 1


def _is_near(place: _Line | Pose, pose: Pose, reach_m: float) -> bool:
    """Whether x and y are each within reach."""
    return abs(pose[0] - place[0]) < reach_m and abs(pose[1] - place[1]) < reach_m


def _line(gate: Gate) -> _Line:
    (lx, ly), (rx, ry) = gate.left_m.tolist(), gate.right_m.tolist()
    width = math.hypot(lx - rx, ly - ry)
    # Forwards is the way from the right post to the left one, turned to the right.
    cos, sin = (ly - ry) / width, -(lx - rx) / width
    return _Line(0.5 * (lx + rx), 0.5 * (ly + ry), cos, sin, 0.5 * width)


def _crossings(corners: list[tuple[float, float]]) -> list[float]:
    """Where the sides of the outline cut the gate's line x = 0: their y, [m]."""
    sides = zip(corners, corners[1:] + corners[:1], strict=True)
    return [ya + (yb - ya) * xa / (xa - xb) for (xa, ya), (xb, yb) in sides if (xa < 0) != (xb < 0)]
