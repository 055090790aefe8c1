"""What can fail, when, and what is heard of it then."""

from twin.faults.fault import ACTUATORS, KINDS, Fault, parse
from twin.faults.timeline import Faults

__all__ = ["ACTUATORS", "KINDS", "Fault", "Faults", "parse"]
