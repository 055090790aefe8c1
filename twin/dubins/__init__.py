"""The simulator of the paper's section 6.5: a point that drives (6.9), (6.10) among circles.

It stands behind the same protocol as the twin of ION, so the navigator cannot tell them apart but
by its parameter file: sensor messages out, actuator targets in, every 20 ms.
"""

from twin.dubins.circles import circles_of
from twin.dubins.parameters import DubinsParameters, dubins_parameters
from twin.dubins.simulator import DubinsSimulator

__all__ = ["DubinsParameters", "DubinsSimulator", "circles_of", "dubins_parameters"]
