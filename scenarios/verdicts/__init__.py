"""How a drive is judged: every figure from the true state, each defined once, here.

Reference point: ground midpoint of the two rear axles. Outline: a rectangle of 3.05 x 1.52 m.
"""

from scenarios.verdicts.judge import Judge

__all__ = ["Judge"]
