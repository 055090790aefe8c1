"""What a physics step costs: `python tests/bench_physics.py` prints microseconds a step.

A plant on the NQE course, once with our contacts of the tires and once with MuJoCo's own, in turn,
from the same states. Counts processor time, so that a busy machine changes it less.
"""

import pickle
import time

import mujoco
import numpy as np

from nav.messages import ActuatorTargets, Gear
from scenarios.nqe import build
from twin import clock
from twin.plant import Plant
from twin.simulator import Simulator

STEPS = 300
STATES = 8
ROUNDS = 5


def states() -> list[Plant]:
    """The plant every two seconds of a straight drive."""
    simulator = Simulator(build(0).world, 0)
    found: list[Plant] = []
    for tick in range(100 * STATES):
        simulator.advance(ActuatorTargets(simulator.time_ns, 0.0, 0.25, 0.0, Gear.HIGH))
        if tick % 100 == 99:
            found.append(pickle.loads(pickle.dumps(simulator.plant)))
    return found


def with_stock_contacts(plant: Plant) -> Plant:
    """The same, its tires no longer marked as ours."""
    plant = pickle.loads(pickle.dumps(plant))
    plant.model.geom_user[:] = 0.0
    return plant


def step_us(plant: Plant) -> float:
    """Time of a whole step; the plant drives on."""
    plant = pickle.loads(pickle.dumps(plant))
    now = clock.time_ns(plant.k)
    plant.apply(now, ActuatorTargets(now, 0.0, 0.25, 0.0, Gear.HIGH))
    start = time.process_time()
    for _ in range(STEPS):
        plant.step()
    return (time.process_time() - start) / STEPS * 1e6


def collision_us(plant: Plant) -> float:
    """Time of collision detection in one state, over and over."""
    plant = pickle.loads(pickle.dumps(plant))
    start = time.process_time()
    for _ in range(STEPS):
        mujoco.mj_collision(plant.model, plant.data)
    return (time.process_time() - start) / STEPS * 1e6


def main() -> None:
    """Print the table."""
    ours = states()
    theirs = [with_stock_contacts(p) for p in ours]
    for name, measure in (("step", step_us), ("collision", collision_us)):
        rounds = [[[measure(p) for p in side] for side in (ours, theirs)] for _ in range(ROUNDS)]
        mine, stock = np.min(rounds, axis=0).mean(axis=1)
        print(f"{name:10s} ours {mine:5.1f} us, stock {stock:5.1f} us, ratio {stock / mine:.2f}")


if __name__ == "__main__":
    main()
