"""One fault as a line of text: which device, how it fails, from when or where, and until when."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

KINDS = {
    "silent": "nothing is heard of it; an actuator has no power",
    "frozen": "it says the same again and again; an actuator stays where it is",
    "noisy": "what it says has a large random error",
    "offset": "what it says is wrong by a constant",
    "late": "what it says arrives late",
    "flapping": "it is silent for the first half of each period",
}
"""The kinds of fault, and what each does."""
ACTUATORS = ("steering", "throttle", "brake", "gear")
GEAR_KINDS = ("silent", "frozen", "late", "flapping")
"""A gear is one of four: it has no noise and no offset."""
EXAMPLE = "lidar_bumper silent 120s"
_NUMBER = r"\d+(?:\.\d+)?"
_LINE = re.compile(
    rf"(?P<device>\w+) +(?P<kind>\w+)(?: +by +(?P<size>-?{_NUMBER}))?"
    rf" +(?P<begins>{_NUMBER})(?P<unit>s|m)(?:-(?P<ends>{_NUMBER})(?P=unit))?"
    rf"(?: +recovers +(?P<recovers>{_NUMBER})s)?"
)


@dataclass(frozen=True)
class Fault:
    """What happens to one device, and when."""

    device: str
    """A sensor as `SensorSuite` names it, or one of `ACTUATORS`."""
    kind: str
    """One of `KINDS`."""
    begins: float = 0.0
    ends: float = inf
    unit: str = "s"
    """`s`: seconds since the start; `m`: metres of way since the start, so that it has a place."""
    size: float | None = None
    """How noisy, how wrong, how late [s], or of which period [s]; None: as is usual."""
    recovers_s: float | None = None
    """It works again this long after a reset; None where a reset does not help."""

    def __str__(self) -> str:
        size = "" if self.size is None else f" by {self.size:g}"
        end = "" if self.ends == inf else f"-{self.ends:g}{self.unit}"
        again = "" if self.recovers_s is None else f" recovers {self.recovers_s:g}s"
        return f"{self.device} {self.kind}{size} {self.begins:g}{self.unit}{end}{again}"

    def holds(self, time_s: float, way_m: float) -> bool:
        """Whether it has begun and not ended by itself."""
        return self.begins <= (way_m if self.unit == "m" else time_s) < self.ends


def parse(line: str, known: Sequence[str]) -> Fault:
    """The fault that a line describes: `DEVICE KIND [by SIZE] FROM[-TO] [recovers SECONDS]`.

    Args:
        line: such as `lidar_bumper silent 120s`, `gps offset by 5 1200m-1300m`.
        known: names of the devices that can fail.

    Raises:
        ValueError: it is no such line; says what would be one.
    """
    found = _LINE.fullmatch(line.strip())
    if not found:
        form = "DEVICE KIND [by SIZE] FROM[-TO] [recovers SECONDS]"
        raise ValueError(f"{line!r}: expected {form}, such as '{EXAMPLE}' or '... 800m-900m'")
    fault = Fault(
        device=found["device"],
        kind=found["kind"],
        begins=float(found["begins"]),
        ends=float(found["ends"] or inf),
        unit=found["unit"],
        size=float(found["size"]) if found["size"] else None,
        recovers_s=float(found["recovers"]) if found["recovers"] else None,
    )
    if wrong := _wrong(fault, known):
        raise ValueError(f"{line!r}: {wrong}")
    return fault


def _wrong(fault: Fault, known: Sequence[str]) -> str:
    """What is wrong with a fault, or nothing."""
    kinds = GEAR_KINDS if fault.device == "gear" else tuple(KINDS)
    if fault.device not in known:
        there_are = ", ".join(known) or "none"
        return f"no device {fault.device!r} can fail here; known are {there_are}"
    if fault.kind not in kinds:
        return f"no kind {fault.kind!r} of fault; known are {', '.join(kinds)}"
    if fault.ends <= fault.begins:
        return "it ends before it begins"
    if fault.size is not None and fault.kind in ("silent", "frozen"):
        return f"what is {fault.kind} has no size; expected no 'by'"
    if fault.size is not None and fault.kind != "offset" and fault.size <= 0.0:
        return f"'by {fault.size:g}': expected a number above 0"
    return ""
