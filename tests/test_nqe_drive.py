"""Whole episodes: the NQE with and without its senses, and the real route (make test-slow)."""

from pathlib import Path

import pytest

from scenarios.course import Course
from scenarios.episode import Episode
from scenarios.nqe import build
from scenarios.route import build as build_route
from scenarios.run import run

REAL = Path(__file__).parents[2] / "shared" / "data" / "gc04_race_rddf.txt"
SEVENTEEN_MINUTES_S = 1020.0
"""What ION took in its second run."""

pytestmark = [pytest.mark.slow, pytest.mark.timeout(1800)]


def figures(course: Course, seed: int, *ablate: str) -> dict:
    return run(Episode(course, seed, ablate), None, [])


@pytest.mark.parametrize("seed", range(20))
def test_ion_drives_the_nqe(seed):
    found = figures(build(seed), seed)
    assert found["outcome"] == "finished"
    assert found["gates_passed"] == found["gates_total"] == 51
    assert (found["contacts"], found["departures"]) == (0, 0)
    assert found["sim_time_s"] < SEVENTEEN_MINUTES_S


@pytest.mark.parametrize("seed", range(20))
def test_who_drives_blind_hits_something(seed):
    assert figures(build(seed), seed, "blind")["contacts"] == 1


@pytest.mark.parametrize("name", ["bumper", "roof", "left", "right"])
def test_each_scanner_is_missed(name):
    """The drive takes longer: the vehicle waits for it, and then goes slower. Or it hits a car."""
    whole, without = (figures(build(0), 0, *ablate) for ablate in ((), (f"no-lidar-{name}",)))
    slower = without["sim_time_s"] > whole["sim_time_s"] + 100.0
    assert slower or without["outcome"] == "contact"


def test_sonars_keep_the_vehicle_in_the_middle_of_the_tunnel():
    seed = 0
    with_sonar, without = (tunnel_offset_m(seed, *ablate) for ablate in ((), ("no-sonar",)))
    assert without > 1.2 * with_sonar


def tunnel_offset_m(seed: int, *ablate: str) -> float:
    """RMS over the tunnel; the drive is cut where the tunnel is far behind."""
    episode = Episode(build(seed), seed, ablate)
    while episode.outcome is None and episode.time_s < 90.0:
        episode.tick()
    return episode.judge.figures()["tunnel_offset_rms_m"]


@pytest.mark.skipif(not REAL.is_file(), reason=f"the real route is not at {REAL}")
def test_the_real_stretch_is_driven_inside_its_corridor():
    course = build_route(REAL.read_text(), REAL.name, 2053, 2120, 0)
    found = figures(course, 0)
    assert found["outcome"] == "finished"
    assert (found["contacts"], found["departures"]) == (0, 0)
