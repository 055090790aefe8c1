"""What can be fitted to a tape: names, units, and how wide to look."""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

Values = Mapping[str, float]
"""By the names of `QUANTITIES`; what is missing is as in the model."""


class Quantity(NamedTuple):
    """One parameter of the vehicle."""

    name: str
    unit: str
    """Empty for a multiple of what the model has."""
    model: float
    """The twin's own value; models/README.md says where it comes from."""
    least: float
    most: float
    """Where it is looked for."""
    words: str

    @property
    def scale(self) -> float:
        """A change of this size is about as large in one parameter as in another."""
        return self.model or 0.1


STEERING_ZERO = "steering_zero"
"""Of the instrument, not of the vehicle: the reading with the wheels straight."""

_ALL = (
    Quantity("mass", "kg", 1040.0, 700.0, 1800.0, "of the whole vehicle"),
    Quantity("friction", "", 0.7, 0.25, 1.2, "between tires and ground, coefficient"),
    Quantity("steering", "", 1.0, 0.6, 1.5, "gain from steering to wheel angle, times the model's"),
    Quantity("cg_height", "m", 0.6165, 0.40, 0.95, "centre of gravity above the ground"),
    Quantity("springs", "", 1.0, 0.5, 2.0, "rate of the suspension, times the model's"),
    Quantity("rolling", "N m", 16.0, 4.0, 40.0, "rolling resistance of a wheel"),
    Quantity("brakes", "", 1.0, 0.5, 1.5, "torque of the brakes, times the model's"),
    Quantity(STEERING_ZERO, "rad", 0.0, -0.05, 0.05, "where the steering reads zero"),
)
QUANTITIES = {q.name: q for q in _ALL}
FITTED = ("mass", "friction", "steering", "cg_height")
"""What is fitted unless something else is asked for."""
ALONG = ("rolling", "brakes", STEERING_ZERO)
"""What is always fitted along: the model only estimates it, or it is the instrument's."""
VEHICLE = tuple(name for name in QUANTITIES if name != STEERING_ZERO)
"""What the vehicle itself has."""


def check(names: Iterable[str], known: Iterable[str] = VEHICLE) -> None:
    """Refuse a name that is none.

    Raises:
        ValueError: it says which, and lists those that exist.
    """
    for name in names:
        if name not in known:
            raise ValueError(f"no parameter {name!r}; known are {', '.join(known)}")
