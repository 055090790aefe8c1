"""Mutants that act wrongly: the healthy navigator's targets change on their way out."""

from collections import deque
from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import partial
from math import copysign, nan, radians

import numpy as np

from nav.messages import ActuatorTargets, Gear, Outputs, SensorMessage
from nav.navigator import IonNavigator
from scenarios.mutants.mutant import Mutant, remade

Act = Callable[[ActuatorTargets], ActuatorTargets]

SECOND_NS = 1_000_000_000
LATE_TICKS = 15
"""0.3 s."""
CROOKED_RAD = radians(3.0)
SHAKING_RAD = 0.15
HALF_LOCK_RAD = 0.288
OPEN = 0.6
"""More than any limit of a trial needs on level ground."""


class Misacting(IonNavigator):
    """Healthy, but for its hands."""

    act: Act

    def step(self, time_ns: int, messages: Sequence[SensorMessage]) -> Outputs:
        """As `nav.messages.Navigator` says."""
        outputs = super().step(time_ns, messages)
        return outputs._replace(targets=self.act(outputs.targets))


@dataclass
class Late:
    """Targets wait in a queue."""

    waiting: deque[ActuatorTargets] = field(default_factory=deque[ActuatorTargets])

    def __call__(self, targets: ActuatorTargets) -> ActuatorTargets:
        """What was meant `LATE_TICKS` ago; at first, what is meant first."""
        self.waiting.append(targets)
        old = self.waiting.popleft() if len(self.waiting) > LATE_TICKS else self.waiting[0]
        return replace(old, time_ns=targets.time_ns)


@dataclass
class Losing:
    """Every second second is lost on the way: what came before stays in force."""

    former: ActuatorTargets | None = None

    def __call__(self, targets: ActuatorTargets) -> ActuatorTargets:
        """The targets, or those of before."""
        if self.former is None or targets.time_ns // SECOND_NS % 2 == 0:
            self.former = targets
        return replace(self.former, time_ns=targets.time_ns)


@dataclass
class Shaking:
    """A large random error on every steering angle."""

    rng: np.random.Generator

    def __call__(self, targets: ActuatorTargets) -> ActuatorTargets:
        """The targets, steered anywhere nearby."""
        error = SHAKING_RAD * float(self.rng.standard_normal())
        return replace(targets, steering_rad=targets.steering_rad + error)


def _rng() -> np.random.Generator:
    key = tuple(b"shaking_steering")
    return np.random.default_rng(np.random.SeedSequence(0, spawn_key=key))


def _reversed(targets: ActuatorTargets) -> ActuatorTargets:
    return replace(targets, steering_rad=-targets.steering_rad)


def _half_lock(targets: ActuatorTargets) -> ActuatorTargets:
    turn = min(abs(targets.steering_rad), HALF_LOCK_RAD)
    return replace(targets, steering_rad=copysign(turn, targets.steering_rad))


def _crooked(targets: ActuatorTargets) -> ActuatorTargets:
    return replace(targets, steering_rad=targets.steering_rad + CROOKED_RAD)


def _braking(share: float, targets: ActuatorTargets) -> ActuatorTargets:
    return replace(targets, brake=share * targets.brake)


def _stuck_throttle(targets: ActuatorTargets) -> ActuatorTargets:
    return replace(targets, throttle=max(targets.throttle, OPEN))


def _throttle_and_brake(targets: ActuatorTargets) -> ActuatorTargets:
    return replace(targets, throttle=1.0) if targets.brake > 0.0 else targets


def _no_reverse(targets: ActuatorTargets) -> ActuatorTargets:
    return replace(targets, gear=Gear.HIGH) if targets.gear is Gear.REVERSE else targets


def _not_a_number(targets: ActuatorTargets) -> ActuatorTargets:
    """For long enough that what holds the last targets cannot hide it."""
    spoiled = targets.time_ns // SECOND_NS % 4 == 3
    return replace(targets, steering_rad=nan) if spoiled else targets


_HANDS: dict[str, tuple[str, Act]] = {
    "reversed_steering": ("Left and right are exchanged.", _reversed),
    "half_lock": ("The steering turns to half its lock at most.", _half_lock),
    "crooked_steering": ("The steering is 3 degrees to the left.", _crooked),
    "shaking_steering": ("The steering angle has a large random error.", Shaking(_rng())),
    "nan_targets": ("In one second of four the steering angle is not a number.", _not_a_number),
    "late_commands": ("Targets leave 0.3 s late.", Late()),
    "lost_commands": ("Targets of every other second are lost.", Losing()),
    "half_brakes": ("The brakes get half of what they should.", partial(_braking, 0.5)),
    "no_brakes": ("The brakes are never applied.", partial(_braking, 0.0)),
    "stuck_throttle": ("The throttle never closes below six tenths.", _stuck_throttle),
    "throttle_while_braking": ("Full throttle while the brakes are applied.", _throttle_and_brake),
    "no_reverse": ("The reverse gear is never asked for.", _no_reverse),
}


def _misacts(act: Act, navigator: IonNavigator) -> IonNavigator:
    """Each with hands of its own, for some remember."""
    return remade(Misacting, navigator, act=deepcopy(act))


ACTING = {name: Mutant(why, partial(_misacts, act)) for name, (why, act) in _HANDS.items()}
"""By name."""
