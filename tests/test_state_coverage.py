"""Every state is entered in a scenario of the repository, and left by each of its transitions."""

from importlib import import_module

import pytest

from nav.states.transitions import TRANSITIONS
from scenarios.episode import Episode

pytestmark = [pytest.mark.slow, pytest.mark.timeout(3600)]

SCENARIOS = {
    "nqe": 120.0,
    "false_wall": 600.0,
    "dead_end": 600.0,
    "sharp_turn": 600.0,
    "real_wall": 600.0,
    "lidar_recovers": 300.0,
    "lidar_lost": 300.0,
    "road": 300.0,
    "tunnel": 100.0,
}
"""Scenarios and how much of each is driven, [s]."""


@pytest.fixture(scope="module")
def seen():
    return {step for name, limit_s in SCENARIOS.items() for step in steps(name, limit_s)}


def steps(name, limit_s):
    """(state before, state after, guard) of each change of state."""
    episode = Episode(import_module(f"scenarios.{name}.course").build(0), 0)
    machine = episode.navigator.high_level.machine
    before, reason = machine.state, machine.reason
    while episode.outcome is None and episode.time_s < limit_s:
        episode.tick()
        if (machine.state, machine.reason) != (before, reason):
            yield before, machine.state, machine.by
            before, reason = machine.state, machine.reason


@pytest.mark.parametrize(
    ("state", "target", "guard"),
    [(s, target, g.__name__) for s, ways in TRANSITIONS.items() for target, g in ways],
)
def test_every_transition_is_driven(seen, state, target, guard):
    assert (state, target, guard) in seen


@pytest.mark.parametrize("guard", ["bites", "lets_go"])
def test_the_watchdog_bites_and_lets_go(seen, guard):
    assert guard in {by for _, _, by in seen}
