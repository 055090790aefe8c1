"""A scenario as a file: what it may say, what is refused and how, and that it drives."""

import pytest

from scenarios.behaviour import Behaviour
from scenarios.bounds import Bound, judged
from scenarios.course import Course
from scenarios.distribution import Distribution, draw
from scenarios.episode import Episode
from scenarios.figure_names import NAMES
from scenarios.scenario import scenario_names
from scenarios.scenario_file import (
    ScenarioFileError,
    built_in,
    from_json,
    read_scenario,
)
from scenarios.settings import begin, check, names
from scenarios.toml_place import line_of
from twin.simulator import Simulator

TEXT = """\
title = "A scanner falls silent on slick ground."
course = "lidar_lost"
faults = ["sonar silent 20s"]
time_limit_s = 300.0

[vary]
"world.friction" = { uniform = [0.4, 0.6] }
"navigator.speed.safe_distance_m" = 2.0
"sensors.lidar.noise_sd_m" = { choice = [0.01, 0.02] }
"judge.patience_s" = 100

[verdicts]
outcome = "finished"
contacts = 0
min_clearance_m = { least = 0.2 }
"states.alarm" = { most = 400.0 }
transitions = { has = ["path_point_keeping>alarm"] }
"""


def read(folder, text=TEXT):
    path = folder / "mine.toml"
    path.write_text(text)
    return read_scenario(path)


def test_a_file_says_what_is_driven(tmp_path):
    scenario = read(tmp_path)
    episode = scenario.episode(3)
    course = episode.course
    assert isinstance(course, Course)
    assert course.title == scenario.title
    assert course.time_limit_s == 300.0
    assert len(course.world.faults) == 2
    assert course.world.friction == scenario.drawn(3)["world.friction"]
    assert episode.navigator.parameters.speed.safe_distance_m == 2.0
    assert episode.judge.patience.seconds == 100.0


def test_seeds_draw_what_varies_each_by_itself(tmp_path):
    scenario = read(tmp_path)
    friction = [scenario.drawn(seed)["world.friction"] for seed in range(20)]
    assert len(set(friction)) == 20
    assert all(0.4 <= value <= 0.6 for value in friction)
    alone = read(tmp_path, TEXT.replace('"judge.patience_s" = 100\n', ""))
    assert [alone.drawn(seed)["world.friction"] for seed in range(20)] == friction


def test_sensors_can_be_others(tmp_path):
    noisy = {"sensors.lidar.noise_sd_m": 0.3}
    course = read(tmp_path).drawn_course(0)
    simulator = begin(course, 0, (), noisy).simulator
    assert isinstance(simulator, Simulator)
    as_it_is, other = (begin(course, 0, (), values) for values in ({}, noisy))
    for _ in range(5):
        as_it_is.tick()
        other.tick()
    assert as_it_is.digest.hex() != other.digest.hex()


def test_without_changes_an_episode_is_the_same(tmp_path):
    course = read(tmp_path).drawn_course(0)
    one, two = begin(course, 0), Episode(course, 0)
    for _ in range(5):
        one.tick()
        two.tick()
    assert one.digest.hex() == two.digest.hex()


def test_it_travels_with_all_that_it_needs(tmp_path):
    scenario = read(tmp_path)
    assert from_json(scenario.as_json()) == scenario


def test_a_route_lies_beside_it(tmp_path):
    (tmp_path / "desert.rddf").write_text(
        "1,34.900000,-117.000000,8,10\n2,34.900500,-117.000000,8,10\n3,34.901,-117.0001,8,0\n"
    )
    scenario = read(tmp_path, 'title = "Mine."\nroute = "desert.rddf"\nfrom = 2\nto = 3\n')
    (tmp_path / "desert.rddf").unlink()
    assert len(from_json(scenario.as_json()).drawn_course(0).waypoint_m) == 2


@pytest.mark.parametrize("name", sorted({*scenario_names()} - {"gc05_route", "small_robot"}))
def test_those_that_come_with_ion_are_scenarios_as_well(name):
    scenario = built_in(name)
    assert scenario.name == name
    assert scenario.judged({"outcome": "finished"})[0].passed


def test_the_file_of_a_trial_can_be_ones_own(tmp_path):
    text = """\
title = "A wall of my own."
course = "trial"
time_limit_s = 60.0
waypoints = [[0, 0, 4.0, 10], [60, 0, 4.0, 0]]
things = [{ kind = "tires", at_m = [30, 1.5], half_m = [0.3, 0.3] }]
[verdicts]
contacts = 0
"""
    course = read(tmp_path, text).drawn_course(0)
    assert [o.kind for o in course.world.obstacles] == ["tires"]
    assert course.name == "mine"
    refused(tmp_path, text.replace("half_m", "halb_m"), "line 5: things.halb_m", "half_m")


def refused(folder, text, *words):
    with pytest.raises(ScenarioFileError) as error:
        read(folder, text)
    said = str(error.value)
    assert said.startswith(str(folder / "mine.toml"))
    assert "\n" not in said
    for word in words:
        assert word in said, said


BAD = {
    "an unknown bound": ("least", "leest", "line 15: verdicts.min_clearance_m.leest", "least"),
    "an unknown distribution": ("uniform", "unifrm", "line 7: vary.world.friction", "normal"),
    "an empty range": ("[0.4, 0.6]", "[0.6, 0.4]", "line 7", "[from, to]"),
    "an unknown figure": ("contacts = 0", "contakts = 0", "line 14: verdicts.contakts", "contacts"),
    "an unknown device": ('"sonar sil', '"soner sil', "line 3: faults", "lidar_roof"),
    "an unknown course": ('"lidar_lost"', '"lidar"', "line 2: course", "lidar_lost"),
    "a missing route": ('course = "lidar_lost"', 'route = "no.rddf"', "line 2: route", "no.rddf"),
    "two courses": ("faults", 'route = "no.rddf"\nfaults', "line 3: route", "cannot be read"),
    "an unknown key": ("title", "titel", "line 1: titel", "title"),
    "a word for a number": ("= 2.0", '= "a"', "line 8", "expected float"),
    "an unknown setting": ("world.friction", "world.frction", "line 7", "world.friction"),
    "an unknown option": ("faults", "options = { density = 3 }\nfaults", "line 3", "density"),
    "no bound": ("{ least = 0.2 }", "{}", "line 15", "least"),
    "a number for a word": ('"finished"', "{ least = 1.0 }", "line 13: verdicts.outcome", "a word"),
    "a word for a figure": ("contacts = 0", 'contacts = "no"', "line 14", "is a number"),
    "a table": ("contacts = 0", "states = 0", "line 14: verdicts.states", "states_entered"),
    "no TOML": ("faults = [", "faults = ", "not TOML", "line 3"),
}


@pytest.mark.parametrize("what", BAD)
def test_what_is_wrong_is_told_with_its_line(what, tmp_path):
    old, new, *words = BAD[what]
    assert old in TEXT
    refused(tmp_path, TEXT.replace(old, new, 1), *words)


def test_no_file_and_no_name(tmp_path):
    with pytest.raises(ScenarioFileError, match="cannot be read"):
        read_scenario(tmp_path / "no.toml")
    with pytest.raises(ScenarioFileError, match="nqe"):
        built_in("nqqe")


def test_distributions():
    drawn = [draw("x", Distribution(normal=(5.0, 1.0)), seed) for seed in range(300)]
    assert sum(map(float, drawn)) / 300 == pytest.approx(5.0, abs=0.2)
    drawn = [float(draw("x", Distribution(log_uniform=(1.0, 100.0)), s)) for s in range(300)]
    assert sum(value < 10.0 for value in drawn) == pytest.approx(150, abs=30)
    assert {draw("x", Distribution(choice=("a", "b")), seed) for seed in range(20)} == {"a", "b"}
    assert draw("x", 3.0, 7) == 3.0


def test_verdicts():
    figures = {"contacts": 1, "v": 2.0, "words": ["a", "b"], "none": None, "states": {"alarm": 3.0}}

    def passes(name, bound):
        return judged(figures, {name: bound})[0].passed

    assert passes("contacts", 1)
    assert not passes("contacts", 0)
    assert passes("v", Bound(least=2.0, most=2.0))
    assert not passes("v", Bound(least=2.1))
    assert not passes("v", Bound(most=1.9))
    assert passes("words", Bound(has=("a",), lacks=("c",)))
    assert not passes("words", Bound(has=("c",)))
    assert not passes("words", Bound(lacks=("a",)))
    assert not passes("none", Bound(least=0.0))
    assert not passes("v", Bound(has=("a",)))
    assert not passes("v", Bound(lacks=("a",)))
    assert not passes("words", Bound(least=0.0))
    assert passes("states.alarm", Bound(most=3.0))
    assert passes("states.rollback", 0.0)


def test_the_figures_are_those_of_a_drive(tmp_path):
    episode, behaviour = read(tmp_path).episode(0), Behaviour()
    records = episode.tick()
    behaviour(episode, records)
    assert set(NAMES) <= {*episode.figures(), *behaviour.figures()}
    assert {*episode.judge.figures(), *behaviour.figures()} <= set(NAMES)


def test_each_setting_may_have_the_value_that_it_has():
    for name, value in names().items():
        check(name, value)
    with pytest.raises(ValueError, match="cannot be set"):
        check("navigator.speed", 1.0)


def test_a_place_in_a_file_is_found_however_it_is_written():
    text = 'a = 1\n[b]\n"c.d" = { e = 1 }\nf.g = 2\n[[h]]\ni = 3\n'
    found = [line_of(text, p) for p in (["b", "c.d", "e"], ["b", "f", "g"], ["h", 0, "i"], ["z"])]
    assert found == [3, 4, 6, None]


def test_faults_may_be_more(tmp_path):
    more = read(tmp_path).failing(["gps silent 30s"], ["no-radar"])
    assert len(more.drawn_course(0).world.faults) == 3
    assert more.ablate == ("no-radar",)
