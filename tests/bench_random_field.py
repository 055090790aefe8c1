"""What a random field costs: `python tests/bench_random_field.py [episodes]`.

Milliseconds a simulated second of whole episodes, from the drawing of the field to the verdict,
without a tape; the last line is what a thousand of them take on two cores. The meter's own share is
about 2 ms.
"""

import sys
import time

import scenarios.episode
from ion.bench.meter import Parts, metering
from nav.control.low_level import LowLevelController
from nav.fusion.ego_state import EgoState
from nav.fusion.obstacle_map import ObstacleMap
from nav.high_level import HighLevelController
from nav.navigator import IonNavigator
from scenarios.episode import Episode
from scenarios.random_field import course
from scenarios.verdicts import Judge
from tape.digest import Digest
from twin.dubins import DubinsSimulator, sensors

SENSORS = (sensors.FieldScan, sensors.FieldGps, sensors.FieldCompass, sensors.FieldOdometry)
PARTS: Parts = {
    "field, feasibility": [(course, "build")],
    "start": [(Episode, "__init__")],
    "plant": [(DubinsSimulator, "advance"), (DubinsSimulator, "truth")],
    "sensors": [(sensor, "measure") for sensor in SENSORS],
    "navigator: ego state": [(EgoState, name) for name in ("update", "estimate", "pose_at")],
    "navigator: map": [(ObstacleMap, "integrate"), (ObstacleMap, "recenter")],
    "navigator: decision": [(HighLevelController, "decide")],
    "navigator: control": [(LowLevelController, "step")],
    "navigator: rest": [(IonNavigator, "step")],
    "judge": [(Judge, "observe")],
    "encode, digest": [(scenarios.episode, "record"), (Digest, "update")],
}


def drive(seed: int) -> float:
    """A whole episode; returns the simulated time, [s]."""
    episode = Episode(course.build(seed), seed)
    while episode.outcome is None:
        episode.tick()
    return episode.time_s


def main() -> None:
    """Print the table."""
    episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    with metering(PARTS) as meter:
        drive(0)  # what is compiled, is compiled now
        meter.restart()
        start_s = time.process_time()
        driven_s = [drive(seed) for seed in range(episodes)]
        meter.switch("rest")
    spent_s = time.process_time() - start_s
    wall_s, total = sum(meter.spent_s.values()), spent_s / sum(driven_s) * 1e3
    for part, part_s in meter.spent_s.items():
        print(f"{part:22s}{part_s / wall_s * total:8.2f} ms")
    print(f"{'total':22s}{total:8.2f} ms")
    each_s, sim_s = spent_s / episodes, sum(driven_s) / episodes
    print(f"{each_s:.2f} s an episode of {sim_s:.0f} s; a thousand: {each_s * 500 / 60:.1f} min")


if __name__ == "__main__":
    main()
