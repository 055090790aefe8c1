"""The failure search: its space and cost, what it finds of a function, how it shrinks, and the
command."""

import json
import sys
import tomllib
from contextlib import nullcontext
from statistics import median

import msgspec
import numpy as np
import pytest
from planted import PLANTED, scenario_of
from test_cli import ion, refused

from ion.falsify import command
from ion.falsify.cost import cost, margin
from ion.falsify.drives import FILE, BrokenDriveError, Drives
from ion.falsify.picture import draw, telling
from ion.falsify.samplers import Model, Random
from ion.falsify.search import Episode, search
from ion.falsify.shrink import Shrunk, shrunk
from ion.falsify.space import Point, Space, usual
from ion.falsify.written import failing_table, toml, write
from scenarios.bounds import Bound, judged
from scenarios.distribution import Distribution, quantile
from scenarios.scenario_file import ScenarioFile, read_scenario
from scenarios.suites import read_suite

GRIP, CAP = "world.friction", "navigator.planning.speed.cap_mps"
NOISE = "sensors.lidar.noise_sd_m"
USUAL = {GRIP: 0.8, CAP: 6.8, NOISE: 0.0047}
VARY = {
    GRIP: Distribution(uniform=(0.3, 0.9)),
    CAP: Distribution(uniform=(3.0, 7.0)),
    NOISE: Distribution(log_uniform=(0.002, 0.02)),
}
CLEAR = Bound(least=0.3)
MADE_UP = ScenarioFile(
    title="Made up.", name="made_up", course="nqe", vary=VARY,
    verdicts={"contacts": 0, "min_clearance_m": CLEAR},
    faults=("gps silent 60s", "lidar_roof silent 8s"),
)  # fmt: skip
SPACE = Space(MADE_UP, tuple(range(5, 25)))
TEXT = """\
title = "A short one."
course = "trial"
time_limit_s = {limit}
waypoints = [[0, 0, 4.0, 10], [40, 0, 4.0, 10], [80, 0, 4.0, 0]]
things = [{{ kind = "wall", at_m = [40, 0.0], half_m = [0.3, 6.0] }}]
[vary]
"world.friction" = {{ uniform = [0.4, 0.9] }}
[verdicts]
outcome = "timeout"
distance_m = {{ least = 0.5 }}
"""


def drive(points):
    """Clear by less, the slicker the ground and the faster; the roof scanner has to be silent."""
    return [made_up(point) for point in points]


def made_up(point):
    values = USUAL | point.scenario.vary
    slick, fast = (0.9 - values[GRIP]) / 0.6, (values[CAP] - 3.0) / 4.0
    silent = "lidar_roof silent 8s" in point.scenario.faults
    clear_m = 1.0 - slick * fast * silent + 0.002 * (point.seed % 3)
    figures = {"contacts": 0, "min_clearance_m": clear_m}
    verdicts = [v._asdict() for v in judged(figures, point.scenario.verdicts)]
    return figures | {
        "verdicts": verdicts, "cost": cost(figures, point.scenario.verdicts), "clear_m": clear_m,
    }  # fmt: skip


def first_failure(sampler, seed, budget=100):
    episodes = search(SPACE, sampler(3, seed), drive, budget, seed)
    numbered = enumerate(episodes, 1)
    return next((k for k, episode in numbered if episode.failed), budget + 1)


def test_quantiles_are_those_of_what_is_drawn():
    assert quantile(Distribution(uniform=(2.0, 4.0)), 0.25) == 2.5
    assert quantile(Distribution(log_uniform=(1.0, 100.0)), 0.5) == pytest.approx(10.0)
    ends = [quantile(Distribution(normal=(5.0, 2.0)), share) for share in (0.0, 0.5, 1.0)]
    assert ends == pytest.approx([-1.0, 5.0, 11.0])
    words = Distribution(choice=("a", "b"))
    assert [quantile(words, share) for share in (0.0, 0.49, 0.5, 1.0)] == ["a", "a", "b", "b"]


def test_a_point_sets_what_is_searched_and_leaves_what_is_fixed():
    fixed = msgspec.structs.replace(MADE_UP, vary={**VARY, "judge.patience_s": 60.0})
    point = Space(fixed, (0,)).point((0.0, 1.0, 0.5), 3)
    assert point.scenario.vary == {"judge.patience_s": 60.0, **point.values}
    assert (point.values[GRIP], point.values[CAP], point.seed) == (0.3, 7.0, 3)
    assert Space(fixed, (0,)).at({}, 3).scenario.vary == {"judge.patience_s": 60.0}


def test_usual_is_what_the_course_and_the_vehicle_have(tmp_path):
    more = """[vary]
"judge.patience_s" = { uniform = [60.0, 80.0] }
"sensors.lidar.delay_steps" = { choice = [4] }"""
    path = tmp_path / "short.toml"
    path.write_text(TEXT.format(limit=1.0).replace("[vary]", more))
    expected = {GRIP: 0.8, "judge.patience_s": 70.0, "sensors.lidar.delay_steps": 8}
    assert usual(read_scenario(path)) == expected


MARGINS = [
    (0.6, Bound(least=0.3), 0.5), (0.3, Bound(least=0.3), 0.0), (0.15, Bound(least=0.3), -1 / 3),
    (30.0, Bound(most=40.0), 0.2), (1.0, Bound(most=0.0), -0.5), (5, Bound(least=2, most=4), -0.2),
    ("finished", "finished", 1.0), ("stuck", "finished", -1.0), (0, 0, 1.0), (2, 0, -2 / 3),
    (["a"], Bound(has=("a",)), 1.0), (["a"], Bound(lacks=("a",)), -1.0), (None, CLEAR, -1.0),
]  # fmt: skip


@pytest.mark.parametrize(("value", "expected", "is_so"), MARGINS)
def test_a_margin_is_below_zero_exactly_if_the_verdict_fails(value, expected, is_so):
    found = margin(value, expected)
    assert found == pytest.approx(is_so)
    assert (found >= 0.0) == judged({"f": value}, {"f": expected})[0].passed


def test_where_only_words_are_asked_the_clearance_leads_down():
    costs = [cost({"outcome": "finished", "min_clearance_m": m}, {"outcome": "finished"})
             for m in (2.0, 1.0, 0.1, 0.0)]  # fmt: skip
    assert costs == sorted(costs, reverse=True)
    assert costs[-1] == 0.0
    assert cost({"outcome": "contact"}, {"outcome": "finished"}) == -1.0
    assert cost({"outcome": "finished"}, {"outcome": "finished"}) > 0.9


def test_the_model_needs_fewer_drives_than_chance():
    ours = [first_failure(Model, seed, 30) for seed in range(3)]
    assert median(ours) < 0.5 * median(first_failure(Random, seed) for seed in range(40))


@pytest.mark.parametrize("at_once", [1, 3])
def test_a_search_is_the_same_each_time(at_once):
    def points():
        found = search(SPACE, Model(3, 4), drive, 10, 4, at_once)
        return [(episode.point.values, episode.point.seed) for episode in found]

    assert points() == points()
    assert len(points()) == 10
    assert len({str(point) for point in points()}) == 10


@pytest.mark.parametrize("name", PLANTED)
def test_planted_faults_are_rare_and_come_on_gradually(name):
    space, rng = Space(scenario_of(name), (0,)), np.random.default_rng(0)
    places = rng.random((500, len(space.varied))).tolist()
    severity = [PLANTED[name].severity(space.point(place, 0).values) for place in places]
    assert 0.0 < np.mean(np.array(severity) > 0.6) < 0.08
    assert np.mean(np.array(severity) < 0.1) > 0.5
    assert len(set(severity)) > 50


def test_seeds_take_turns_and_are_all_that_is_searched_where_nothing_varies():
    space = Space(msgspec.structs.replace(MADE_UP, vary={}), (3, 7, 9))
    seeds = [e.point.seed for e in search(space, Model(0, 0), drive, 3, 0)]
    assert sorted(seeds) == [3, 7, 9]


def worst_case():
    point = SPACE.at({GRIP: 0.31, CAP: 6.9, NOISE: 0.01}, 11)
    return Episode(point, drive([point])[0])


def test_a_case_shrinks_to_what_is_needed():
    small = shrunk(SPACE, drive, USUAL, worst_case(), 60)
    assert small.figure == "min_clearance_m"
    point = small.episode.point
    assert list(point.values) == [GRIP]
    edge = 0.9 - 0.6 * 0.7 / 0.95
    assert edge - 0.04 < point.values[GRIP] <= edge
    assert point.scenario.faults == ("lidar_roof silent 8s",)
    assert point.seed == min(SPACE.seeds)
    assert "min_clearance_m" in small.episode.failed
    assert small.other_seeds == 4


@pytest.mark.parametrize("budget", [0, 1, 3])
def test_a_small_budget_leaves_a_case_that_fails(budget):
    small = shrunk(SPACE, drive, USUAL, worst_case(), budget)
    assert small.figure in small.episode.failed
    assert small.drives <= budget


def test_what_is_written_can_be_read_and_says_the_same(tmp_path):
    (tmp_path / "short.toml").write_text(TEXT.format(limit=1.0))
    table = tomllib.loads(TEXT.format(limit=1.0))
    space = Space(read_scenario(tmp_path / "short.toml"), (0, 1))
    point = space.at({GRIP: 0.41}, 1, faults=("gps silent 1s",))
    small = Shrunk(Episode(point, {}), "distance_m", 3, 4, 2)
    path = write(tmp_path, table, small, ["Found by hand."])
    read = read_scenario(path)
    assert read.trial == msgspec.structs.replace(space.scenario.trial, title=read.title)
    assert (read.vary, read.faults) == ({GRIP: 0.41}, ("gps silent 1s",))
    assert read.verdicts == {"distance_m": Bound(least=0.5)}
    text = path.read_text()
    assert text.startswith("# Found by hand.\n")
    assert "seed 1, and with 2 of 4 other seeds" in text


def test_toml_of_all_kinds():
    table = {"a": 'say "no"', "b": [1, 2.5e-7, True], "c": {"x.y": {"least": 0.0}}, "d": [[1], [2]]}
    assert tomllib.loads("\n".join(toml(table))) == table
    assert "ablate" not in failing_table({"title": "T."}, MADE_UP, "contacts")


def test_pictures_of_two_names_of_one_and_of_none(tmp_path):
    episodes = list(search(SPACE, Random(3, 0), drive, 20, 0))
    assert set(telling(episodes, list(VARY))) == {GRIP, CAP}
    for count in (3, 1, 0):
        varied = dict(list(VARY.items())[:count])
        draw(episodes, varied, "Made up.", tmp_path / f"{count}.png")
        assert (tmp_path / f"{count}.png").stat().st_size > 10_000


def one_by_one(driven):
    """As `scenarios.batch.workers` gives it, but each drive comes to `driven`."""

    def many(work, numbers):
        for number in numbers:
            counted.append(number)
            yield {"number": number, "seed": number} | driven

    counted = []
    return many, counted


def test_each_point_is_driven_once_and_kept_to_the_bit(tmp_path):
    many, counted = one_by_one({"outcome": "finished", "cost": 0.1 + 0.2})
    points = [SPACE.at({GRIP: 0.5}, seed) for seed in (1, 2, 1)]
    found = Drives(tmp_path, "code", many)(points)
    assert [row["seed"] for row in found] == [0, 1, 0]
    assert Drives(tmp_path, "code", many)(points) == found
    assert len(counted) == 2
    Drives(tmp_path, "another", many)(points[:1])
    assert len(counted) == 3
    assert json.loads((tmp_path / FILE).read_text().splitlines()[0])["cost"] == 0.1 + 0.2


@pytest.mark.parametrize(
    ("outcome", "raised"), [("error", BrokenDriveError), ("interrupted", KeyboardInterrupt)]
)
def test_a_drive_that_breaks_or_is_stopped_is_not_kept(outcome, raised, tmp_path):
    many, _ = one_by_one({"outcome": outcome, "message": "it broke"})
    with pytest.raises(raised):
        Drives(tmp_path, "code", many)([Point(MADE_UP, {}, 0)])
    assert not (tmp_path / FILE).exists()


ENDS = {
    "nothing failed": ("finished", 0, "nothing failed in 3 drives"),
    "a drive broke": ("error", 3, "a drive broke: seed"),
    "it was stopped": ("interrupted", 130, "say it again"),
}


@pytest.mark.parametrize("what", ENDS)
def test_how_else_a_search_ends(what, monkeypatch, capsys, tmp_path):
    outcome, expected, words = ENDS[what]
    passes = {"outcome": outcome, "cost": 0.5, "clear_m": 1.0, "verdicts": [], "message": "why"}
    made_up_workers = nullcontext(one_by_one(passes)[0])
    monkeypatch.setattr(command, "workers", lambda jobs: made_up_workers)
    arguments = ("falsify", "real_wall", "--seeds", "0-2", "--out", tmp_path)
    code, out, err = ion(monkeypatch, capsys, *arguments)
    assert code == expected
    assert words in out + err


BAD = {
    "an unknown scenario": (["nowhere"], "nqe"),
    "no budget": (["nqe", "--budget", "0"], "--budget 0: expected 1 or more"),
    "no jobs": (["nqe", "--jobs", "0"], "--jobs 0"),
    "a negative seed": (["nqe", "--search-seed", "-1"], "--search-seed -1"),
    "no seeds": (["nqe", "--seeds", "x"], "--seeds"),
    "nothing to search": (["nqe", "--seeds", "7"], "expected a distribution in its [vary]"),
    "no such file": (["nowhere.toml"], "cannot be read"),
}


@pytest.mark.parametrize("what", BAD)
def test_what_is_wrong_is_one_line(what, monkeypatch, capsys, tmp_path):
    arguments, expected = BAD[what]
    assert expected in refused(monkeypatch, capsys, "falsify", *arguments, "--out", tmp_path)


def test_without_the_extra_it_says_what_to_install(monkeypatch, capsys, tmp_path):
    path = tmp_path / "short.toml"
    path.write_text(TEXT.format(limit=0.5))
    monkeypatch.setitem(sys.modules, "sklearn", None)
    assert "pip install 'ion-twin[search]'" in refused(monkeypatch, capsys, "falsify", path)


def test_a_real_search_finds_shrinks_and_writes_what_drives_again(monkeypatch, capsys, tmp_path):
    path = tmp_path / "short.toml"
    path.write_text(TEXT.format(limit=0.5))
    arguments = ("falsify", path, "--seeds", "2-4", "--out", tmp_path, "--json", "--budget", 3)
    code, out, _ = ion(monkeypatch, capsys, *arguments)
    told = json.loads(out)
    assert (code, told["episodes"], told["failed"], told["figure"]) == (1, 1, 1, "distance_m")
    assert (told["values"], told["seed"]) == ({}, 2)
    written = tmp_path / "falsify_short" / "short_distance_m.toml"
    assert told["file"] == str(written)
    kept = (tmp_path / "falsify_short" / FILE).read_text()
    again = json.loads(ion(monkeypatch, capsys, *arguments)[1])
    assert again == told
    assert (tmp_path / "falsify_short" / FILE).read_text() == kept
    suite = tmp_path / "held.toml"
    suite.write_text(f'title = "Held."\n[[run]]\nscenario = "{written}"\nseeds = "2"\n')
    assert read_suite(str(suite)).runs[0].scenario.verdicts == {"distance_m": Bound(least=0.5)}
    code, out, _ = ion(monkeypatch, capsys, "drive", written, "--seed", 2, "--json", "--log", "off")
    assert (code, json.loads(out)["verdicts"][0]["passed"]) == (1, False)
