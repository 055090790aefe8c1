"""Drive-by-wire: lock to lock, delays, the shift, and the stop when commands stop."""

import numpy as np

from nav.messages import Gear
from scenarios.truth.check import Check, Curve, Range, within
from scenarios.truth.rig import TICK_S, Rig
from twin.linkage import Gearbox, GearboxParameters
from twin.vehicle import STEERING_LIMIT_RAD

SHIFTS = 400


def lock_to_lock() -> Check:
    """Of the steering, from one end to the other."""
    rig = Rig().drive(4.0, steering_rad=-STEERING_LIMIT_RAD, brake=1.0)
    began = len(rig.moments)
    rig.drive(6.0, steering_rad=STEERING_LIMIT_RAD, brake=1.0)
    angle = rig.of("steering_rad")[began:]
    moving = TICK_S * np.count_nonzero(np.abs(np.diff(angle)) > 1e-9)
    time_s = np.arange(len(angle), dtype=np.float64) * TICK_S
    return Check(
        title="Steering, lock to lock", unit="s", twin=float(moving), grade="published",
        source="Overbot: 4.0 s",
        curve=Curve(time_s, "time since the command [s]", "steering [rad]", {"twin": angle}),
        allowed=within(4.0, 0.05),
    )  # fmt: skip


def steering_delay() -> Check:
    """From the command to the first movement."""
    rig = Rig().drive(1.0, brake=1.0)
    began = rig.time_s
    rig.until(lambda m: abs(m.steering_rad) > 1e-4, 2.0, steering_rad=0.3, brake=1.0)
    return Check(
        title="Steering delay", unit="s", twin=rig.time_s - began, grade="published",
        source="Overbot: 0.30 s", allowed=within(0.30, 0.1),
    )  # fmt: skip


def shifts() -> Check:
    """Times from High to Reverse and back, many of them: the longest."""
    box = Gearbox(GearboxParameters(), np.random.default_rng(0), Gear.HIGH)
    targets = (Gear.REVERSE if k % 2 else Gear.HIGH for k in range(1, SHIFTS))
    taken = np.sort(np.array([_shifted(box, target) for target in targets], np.float64))
    share = np.linspace(0.0, 1.0, len(taken))
    return Check(
        title=f"Gear shift between R and H, {SHIFTS} of them: the longest", unit="s",
        twin=float(taken.max()), allowed=Range(10.0, 60.0), grade="published",
        source='"up to one minute in some situations" (the paper)',
        remark=f"The shortest {taken.min():.1f} s, the median {np.median(taken):.1f} s.",
        curve=Curve(taken, "time of a shift [s]", "share that takes less", {"twin": share}),
    )  # fmt: skip


def _shifted(box: Gearbox, target: Gear) -> float:
    steps = 0
    while box.shifting or box.gear != target:
        box.step(target, 0.0, 0.01)
        steps += 1
    return 0.01 * steps


def lost_commands() -> Check:
    """From the last command, at 8 m/s, to a stand."""
    rig = Rig().cruise(10.0, 8.0)
    began = rig.plant.k
    while rig.plant.speed_mps > 0.05 and rig.plant.k - began < 3000:
        rig.plant.step()
    return Check(
        title="Commands lost at 8 m/s: until it stands", unit="s",
        twin=(rig.plant.k - began) / 300.0, allowed=Range(1.5, 4.0), grade="estimated",
        source="0.5 s of patience, and a full brake of some 5 m/s^2",
    )  # fmt: skip
