"""Which part of a drive takes how much of its time."""

from ion.bench.meter import Parts, metering
from ion.bench.race import drive_s
from nav.navigator import IonNavigator
from scenarios.episode import Episode
from scenarios.verdicts import Judge
from twin.sensors.lidar import Lidar
from twin.sensors.suite import SensorSuite
from twin.simulator import Simulator

DIGEST = "digest"
PARTS: Parts = {
    "physics": [(Simulator, "advance"), (Simulator, "truth")],
    "lidar": [(Lidar, "measure")],
    "other_sensors": [(SensorSuite, "poll")],
    "navigator": [(IonNavigator, "step")],
    "judge": [(Judge, "observe")],
    DIGEST: [(Episode, "tick")],
}
"""Few and large, so that metering them takes little. `physics` is MuJoCo with all that moves the
vehicle and the ground under it; `digest`, all that remains of a tick, encodes and digests what goes
on a tape."""


def shares(episode: Episode, ticks: int) -> dict[str, float]:
    """Drive on for so many ticks of 20 ms, or to the end; the share of each part, in all 1."""
    with metering(PARTS) as meter:
        drive_s(episode, ticks)
        meter.switch("rest")
    spent_s = [meter.spent_s[part] for part in PARTS]
    total_s = sum(spent_s)
    return {part: part_s / total_s for part, part_s in zip(PARTS, spent_s, strict=True)}
