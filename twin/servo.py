"""A position servo: a command of finite counts arrives late, and a motor runs after it."""

from collections import deque
from dataclasses import dataclass

from twin.faults import Faults


@dataclass(frozen=True)
class ServoParameters:
    """One actuator of the drive-by-wire unit."""

    low: float
    high: float
    """The ends of its travel."""
    rate_per_s: float
    """How fast it goes, in its unit a second."""
    delay_s: float
    count: float
    """Commands come in steps of this."""
    dead_band: float
    """The motor does not start for less; once it runs, it runs to the target."""
    unpowered: float | None
    """Where a spring brings it without power; None: it stays."""


class Delay:
    """What was put in comes out when it is old enough."""

    def __init__(self, delay_s: float, value: float) -> None:
        self.value = value
        self._delay_ns = round(delay_s * 1e9)
        self._waiting: deque[tuple[int, float]] = deque()

    def put(self, time_ns: int, value: float) -> None:
        """Say `value` at `time_ns`; what is said later, but heard earlier, is lost."""
        self._waiting.append((time_ns + self._delay_ns, value))

    def get(self, time_ns: int) -> float:
        """The newest value that is old enough."""
        while self._waiting and self._waiting[0][0] <= time_ns:
            self.value = self._waiting.popleft()[1]
        return self.value

    def clear(self, value: float) -> None:
        """Forget what waits; `value` holds at once."""
        self._waiting.clear()
        self.value = value


class Servo:
    """Where one actuator is."""

    def __init__(self, name: str, parameters: ServoParameters, position: float) -> None:
        self.name, self.parameters = name, parameters
        self.position = position
        self._command = Delay(parameters.delay_s, position)
        self._runs = False

    def put(self, time_ns: int, target: float) -> None:
        """Command a position; beyond the ends it is the end."""
        p = self.parameters
        counts = round((clip(target, p.low, p.high) - p.low) / p.count)
        self._command.put(time_ns, clip(p.low + counts * p.count, p.low, p.high))

    def hold(self, target: float) -> None:
        """This position at once, whatever is on its way."""
        self._command.clear(target)

    def step(self, time_ns: int, dt_s: float, faults: Faults) -> float:
        """Advance by `dt_s`; the position at `time_ns`."""
        p = self.parameters
        fails = self.name in faults
        target = self._target(time_ns, faults) if fails else self._command.get(time_ns)
        self._runs = abs(target - self.position) > (0.0 if self._runs else p.dead_band)
        if self._runs:
            self.position = towards(self.position, target, p.rate_per_s * dt_s)
        return self.position

    def _target(self, time_ns: int, faults: Faults) -> float:
        """What the motor goes for: with a fault, something else than was commanded."""
        p = self.parameters
        late_ns = round(faults.late_s(time_ns, self.name) * 1e9)
        target = self._command.get(time_ns - late_ns)
        if faults.frozen(time_ns, self.name):
            return self.position
        if faults.silent(time_ns, self.name):
            return self.position if p.unpowered is None else p.unpowered
        for k, fault in faults.spoils(time_ns, self.name):
            size = USUAL_SHARE * (p.high - p.low) if fault.size is None else fault.size
            target += size * (faults.rng(k).standard_normal() if fault.kind == "noisy" else 1.0)
        return clip(target, p.low, p.high)


USUAL_SHARE = 0.1
"""Of its travel: how noisy or wrong a failing actuator usually is (estimated)."""


def clip(value: float, low: float, high: float) -> float:
    """The nearest value within both ends."""
    return min(max(value, low), high)


def towards(value: float, target: float, step: float) -> float:
    """Where a value is that goes to a target by at most a step."""
    if value == target:
        return value
    return value + clip(target - value, -step, step)
