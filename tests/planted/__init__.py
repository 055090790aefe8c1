"""Five planted faults: vehicles that are broken in a rare corner of what their scenario varies.

Each is healthy in almost all drives, and worse the nearer the circumstances come to the corner, as
what wears, slips or runs hot is. The failure search is to find them (`tests/bench_falsify.py`).
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from nav.messages import LIDAR_NO_RETURN_M, ActuatorTargets, GpsFix, LidarScan
from scenarios.episode import Episode
from scenarios.mutants.acting import Misacting
from scenarios.mutants.hearing import Each, Mishearing
from scenarios.mutants.mutant import remade
from scenarios.scenario_file import ScenarioFile, read_scenario

FOLDER = Path(__file__).parent
METRES_A_DEGREE = 111_000.0
"""Of latitude."""
BEAMS_A_RAD = 360 / np.pi

GRIP, CAP = "world.friction", "navigator.planning.speed.cap_mps"
GAIN = "navigator.control.speed.brake_proportional"
LOOSE, CROOKED = "sensors.mounting.position_sd_m", "sensors.mounting.angle_sd_rad"
LATE, NOISE = "sensors.lidar.delay_steps", "sensors.lidar.noise_sd_m"
BIAS, COMPASS = "sensors.gps.bias_sd_m", "sensors.compass.bias_sd_rad"
USUAL = {
    GRIP: 0.8, CAP: 6.8, GAIN: 0.35, LOOSE: 0.01, CROOKED: 0.0052, LATE: 8, NOISE: 0.0047,
    BIAS: 0.083, COMPASS: 0.026,
}  # fmt: skip
"""What a scenario has that does not say so."""

Circumstances = Mapping[str, Any]


class Planted(NamedTuple):
    """One fault."""

    sentence: str
    """What is broken, and where."""
    severity: Callable[[Circumstances], float]
    """0 where the vehicle is healthy, 1 in the corner."""
    break_by: Callable[[Episode, float], None]
    """Breaks an episode that has not begun, by so much."""

    def __call__(self, episode: Episode, values: Circumstances) -> Episode:
        """As `ion.falsify.drives` asks for it."""
        severity = self.severity(USUAL | dict(values))
        if severity > 0.0:
            self.break_by(episode, severity)
        return episode


def scenario_of(name: str) -> ScenarioFile:
    """What a fault is planted in."""
    return read_scenario(FOLDER / f"{name}.toml")


def ramp(value: float, harmless: float, worst: float) -> float:
    """From 0 at what is harmless to 1 at what is worst, and no farther."""
    return float(np.clip((value - harmless) / (worst - harmless), 0.0, 1.0))


def bell(value: float, middle: float, width: float) -> float:
    """1 in the middle, less to both sides: a resonance."""
    return float(np.exp(-(((value - middle) / width) ** 2)))


def _acting(act: Callable[[ActuatorTargets, float], ActuatorTargets]) -> Any:
    def plant(episode: Episode, severity: float) -> None:
        hands = partial(act, severity=severity)
        episode.navigator = remade(Misacting, episode.navigator, act=hands)

    return plant


def _hearing(ears: Callable[[float], Any]) -> Any:
    def plant(episode: Episode, severity: float) -> None:
        episode.navigator = remade(Mishearing, episode.navigator, hear=ears(severity))

    return plant


def _steers_less(targets: ActuatorTargets, severity: float) -> ActuatorTargets:
    return replace(targets, steering_rad=(1.0 - severity) * targets.steering_rad)


def _brakes_less(targets: ActuatorTargets, severity: float) -> ActuatorTargets:
    return replace(targets, brake=(1.0 - severity) * targets.brake)


def _turned(severity: float) -> Each:
    """Scanners look up to 8 degrees to the right of where they are thought to."""
    beams = round(severity * np.radians(8.0) * BEAMS_A_RAD)

    def turned(scan: LidarScan) -> LidarScan:
        return replace(scan, range_m=np.roll(scan.range_m, beams))

    return Each(LidarScan, turned)


def _shifted(severity: float) -> Each:
    """GPS is up to 1.05 m south of where it is."""

    def shifted(fix: GpsFix) -> GpsFix:
        return replace(fix, latitude_deg=fix.latitude_deg - 1.05 * severity / METRES_A_DEGREE)

    return Each(GpsFix, shifted)


def _lengthened(severity: float) -> Each:
    """Ranges are up to 4.2 m too long."""

    def longer(scan: LidarScan) -> LidarScan:
        return replace(scan, range_m=np.minimum(scan.range_m + 4.2 * severity, LIDAR_NO_RETURN_M))

    return Each(LidarScan, longer)


PLANTED = {
    "understeer": Planted(
        "The faster on the slicker ground, the less of its steering angle the vehicle turns.",
        lambda v: ramp(v[GRIP], 0.65, 0.4) * ramp(v[CAP], 4.0, 6.8),
        _acting(_steers_less),
    ),
    "fading_brakes": Planted(
        "The faster and the harder they are used, the less the brakes hold.",
        lambda v: ramp(v[CAP], 4.0, 6.8) * ramp(v[GAIN], 0.25, 0.6),
        _acting(_brakes_less),
    ),
    "shaken_scanner": Planted(
        "At a speed at which loose mountings shake, the scanners turn to the right.",
        lambda v: bell(v[CAP], 5.0, 0.5) * ramp(v[LOOSE], 0.012, 0.02),
        _hearing(_turned),
    ),
    "long_ranges": Planted(
        "Late, noisy scanners take ranges for longer than they are, and the more the faster.",
        lambda v: ramp(v[LATE], 8, 24) * ramp(v[NOISE], 0.003, 0.012) * ramp(v[CAP], 2.0, 6.0),
        _hearing(_lengthened),
    ),
    "drifting_gps": Planted(
        "Where the compass is bad, the receiver's bias is believed, and grows.",
        lambda v: ramp(v[BIAS], 0.05, 0.15) * ramp(v[COMPASS], 0.01, 0.05),
        _hearing(_shifted),
    ),
}  # fmt: skip
"""By the name of the scenario beside this file."""
