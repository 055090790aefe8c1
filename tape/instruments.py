"""What instruments of a test drive measured, beside the tape: the navigator never hears of it, it
is never replayed and never digested."""

from dataclasses import dataclass

MEASURED = "/measured/"
"""Only topics below it carry what instruments say."""


@dataclass(frozen=True, eq=False)
class DriveTorque:
    """A torque meter on the driveline."""

    time_ns: int
    torque_n_m: float
    """At the wheels, all of them together, forward positive, [N m]."""
