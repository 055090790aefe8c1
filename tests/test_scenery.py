"""What streams past the vehicle is what would have stood there all the time."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from test_route_course import straight_route

from nav.messages import ActuatorTargets, Gear
from scenarios.chunks import KEPT, Chunks
from scenarios.episode import Episode
from scenarios.route import build
from twin.simulator import Simulator
from twin.world import ROOM, SIGHT_M, Obstacle

TARGETS = ActuatorTargets(0, 0.0, 0.6, 0.0, Gear.HIGH)


def course(seed=0, count=30):
    return build(straight_route(count), "r.txt", None, None, seed)


def standing(world):
    """The same world with all its things in place from the start."""
    return replace(world, obstacles=world.everything(), scenery=None)


def hard(world):
    """Without brush: beams through leaves draw numbers where leaves are in sight."""
    things = tuple(o for o in world.everything() if o.kind != "brush")
    middle = np.array([o.center_m[:2] for o in things])
    return replace(world, scenery=Chunks(middle, np.full(len(things), 3.0), One(things)))


class One:
    """A thing a chunk."""

    def __init__(self, things):
        self.things = things

    def __call__(self, k):
        return (self.things[k],)


def block(x, shape="box"):
    return Obstacle("block", "rock", shape, (x, 0.0, 0.0), (0.5, 0.5, 1.5), owner="rock_7")


def test_all_in_sight_is_there_and_nothing_changes_without_need():
    world = course().world
    for x in (0.0, 300.0, 900.0, 1740.0):
        seen = {o.name for o in world.around(x, 5.0)}
        assert world.around(x, 5.0) is world.around(x + 0.01, 5.0)
        for thing in world.everything():
            near = np.hypot(thing.center_m[0] - x, thing.center_m[1] - 5.0) < SIGHT_M
            assert thing.name in seen or not near


def test_what_is_forgotten_is_drawn_again_the_same():
    chunks = course(count=200).world.scenery
    first = chunks.around(50.0, 0.0)
    for x in np.arange(0.0, 11_000.0, 50.0):
        chunks.around(x, 0.0)
    assert len(chunks._drawn) <= KEPT
    assert chunks.around(50.0, 0.0) == first
    assert pickle.loads(pickle.dumps(chunks)).around(50.0, 0.0) == first


@pytest.mark.parametrize("seed", [0, 1])
def test_an_episode_is_the_same_to_the_bit(seed):
    drawn = course(seed)
    passing = hard(drawn.world)
    episodes = [Episode(replace(drawn, world=w), seed) for w in (passing, standing(passing))]
    for _ in range(1000):
        for episode in episodes:
            episode.tick()
    one, other = episodes
    assert one.truth.position_m[0] > 60.0
    assert one.digest.hex() == other.digest.hex()
    assert one.judge.figures() == other.judge.figures()


@pytest.mark.parametrize("shape", ["box", "cylinder"])
def test_the_vehicle_hits_what_it_meets(shape):
    world = course().world
    things = (block(40.0, shape), block(1000.0))
    scenery = Chunks(np.array([[40.0, 0.0], [1000.0, 0.0]]), np.full(2, 3.0), One(things))
    simulators = [
        Simulator(replace(world, scenery=scenery), 0),
        Simulator(replace(world, scenery=None, obstacles=things[:1]), 0),
    ]
    for _ in range(600):
        for simulator in simulators:
            simulator.advance(TARGETS)
        passing, there = (s.truth() for s in simulators)
        assert passing.contacts == there.contacts
        if "rock_7" in passing.contacts:
            return
        assert passing.position_m.tolist() == there.position_m.tolist()
    pytest.fail("nothing was hit")


def test_too_much_near_one_place_is_said():
    world = course().world
    things = tuple(replace(block(3.0 * k), name=f"b{k}") for k in range(ROOM["box"] + 1))
    crowd = [replace(o, center_m=(8.0, 0.2 * k, 0.0)) for k, o in enumerate(things)]
    scenery = Chunks(np.array([[8.0, 0.0]]), np.array([6.0]), lambda k: tuple(crowd))
    with pytest.raises(ValueError, match=r"25 of shape box near b0 at .*, at most 24"):
        Simulator(replace(world, scenery=scenery), 0)
