"""What a tape says beside its messages: enough to show the drive and to repeat it."""

import numpy as np
import pytest

from ion.courses import scenario_source
from ion.job import Job
from ion.recorded import recorded
from tape.digest import Digest
from tape.errors import TapeError
from tape.reader import read
from tape.truth import TRUTH
from tape.writer import TapeWriter

SEED = 3


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    source = scenario_source("random_field", {"density": 20, "field": "traps"})
    return Job(source, tmp_path_factory.mktemp("drive")).drive(SEED)


def test_course_is_drawn_again(drive):
    found = recorded(drive["log"]).course()
    again = scenario_source("random_field", {"density": 20, "field": "traps"}).course(SEED)
    np.testing.assert_array_equal(found.waypoint_m, again.waypoint_m)
    assert found.world.obstacles == again.world.obstacles


def test_command_repeats_it(drive):
    command = recorded(drive["log"]).command
    assert command == "ion drive random_field --density 20 --field traps --seed 3"


def test_figures_are_those_of_the_drive(drive):
    found = recorded(drive["log"]).figures
    assert found["digest"] == drive["digest"]
    assert found["outcome"] == drive["outcome"]


def test_events_tell_the_states_and_end_with_the_outcome(drive):
    events = recorded(drive["log"]).events
    times = [event.time_s for event in events]
    assert times == sorted(times)
    assert events[0].text == "path point keeping: start"
    assert (events[-1].kind, events[-1].text) == ("end", drive["outcome"])


def test_truth_is_beside_the_tape_and_not_in_its_digest(drive):
    digest = Digest()
    for record in read(drive["log"]):
        digest.update(record)
    assert digest.hex() == drive["digest"]
    states = [record.message for record in read(drive["log"], TRUTH)]
    steps = np.diff([state.time_ns for state in states[:-1]])
    assert (steps == 10**8).all()
    assert states[-1].time_ns == pytest.approx(drive["sim_time_s"] * 1e9)
    assert states[0].tire_center_m.shape[1] == 3


def test_tape_of_somebody_else_is_refused(tmp_path):
    log = tmp_path / "other.mcap"
    TapeWriter(log, metadata={"seed": "1"}).close()
    with pytest.raises(TapeError, match="does not say its scenario"):
        recorded(log)


def test_a_drive_of_a_scenario_file_is_drawn_again_without_the_file(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        'title = "Mine."\ncourse = "sharp_turn"\ntime_limit_s = 1.0\n'
        '[vary]\n"world.friction" = { uniform = [0.3, 0.4] }\n[verdicts]\noutcome = "timeout"\n'
    )
    job = Job(scenario_source(str(path)), tmp_path)
    figures = job.drive(3)
    assert figures["verdicts"][0]["passed"]
    path.unlink()
    again = recorded(figures["log"])
    assert again.command == "ion drive mine.toml --seed 3"
    episode = again.episode()
    assert 0.3 < episode.course.world.friction < 0.4
    while episode.outcome is None:
        episode.tick()
    assert episode.digest.hex() == figures["digest"]
