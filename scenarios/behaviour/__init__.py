"""How a drive was driven, beyond whether it succeeded: figures that no verdict hangs on.

From the true state and from what crossed the boundary; the parameters are those that come with the
vehicle, so that a figure means the same for every variant of its navigator.
"""

from scenarios.behaviour.behaviour import Behaviour

__all__ = ["Behaviour"]
