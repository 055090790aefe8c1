"""Suites: what their files say, what is driven, judged, kept and told; and who catches mutants."""

import json
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from test_cli import ion, refused

from ion.suite.baseline import changes
from ion.suite.cases import Case, cases_of
from ion.suite.mutants import Drives, verdict_of
from ion.suite.results import Results
from scenarios.mutants import MUTANTS
from scenarios.suites import SuiteError, read_suite, suite_names

TEXT = """\
title = "Two short drives, one of which cannot pass."
[verdicts]
contacts = 0
[[run]]
scenario = "sharp_turn"
seeds = "0-1"
time_limit_s = 1.0
[run.verdicts]
outcome = "timeout"
[[run]]
scenario = "sharp_turn"
name = "hopeless"
time_limit_s = 1.0
"""


def written(folder, text=TEXT):
    path = folder / "mine.toml"
    path.write_text(text)
    return path


def lines(out):
    return [json.loads(line) for line in out.splitlines()]


@pytest.mark.parametrize("name", suite_names())
def test_those_that_come_with_ion_can_be_read(name):
    suite = read_suite(name)
    assert suite.title.endswith(".")
    assert all(run.scenario.verdicts for run in suite.runs)


def test_a_run_adds_to_its_scenario_and_to_what_all_are_asked(tmp_path):
    first, second = read_suite(str(written(tmp_path))).runs
    assert first.scenario.verdicts == {"outcome": "timeout", "contacts": 0}
    assert (second.scenario.name, second.scenario.verdicts["outcome"]) == ("hopeless", "finished")
    assert first.scenario.time_limit_s == 1.0
    assert (first.seeds, second.seeds) == ((0, 1), (0,))


def test_each_choice_of_words_is_a_run(tmp_path):
    text = TEXT + 'each = { device = ["gps", "imu"], how = ["silent", "late"] }\n'
    text = text.replace("hopeless", "{how}_{device}") + 'faults = ["{device} {how} 8s"]\n'
    runs = read_suite(str(written(tmp_path, text))).runs
    assert [run.scenario.name for run in runs[1:]] == [
        "silent_gps", "late_gps", "silent_imu", "late_imu",
    ]  # fmt: skip
    assert runs[2].scenario.faults == ("gps late 8s",)


def test_all_runs_come_early(tmp_path):
    names = [case.name for case in cases_of(read_suite(str(written(tmp_path))))]
    assert names == ["sharp_turn 0", "hopeless 0", "sharp_turn 1"]


BAD = {
    "an unknown scenario": ('"sharp_turn"\nname', '"sharp"\nname', "line 11: run.scenario", "nqe"),
    "no seeds": ('"0-1"', '"x"', "line 6: run.seeds", "0-19"),
    "an unknown figure": ("outcome =", "outcme =", "line 9: run.verdicts.outcme", "outcome"),
    "an unknown key": ('name = "hope', 'nam = "hope', "line 12: run.nam", "name"),
    "one name twice": ('name = "hopeless"\n', "", "line 10: run", "name one of them"),
    "no such word": ("hopeless", "{what}", "line 10: run.each", "{what}"),
    "no runs": ("[[run]]", "[[ran]]", "ran", "run"),
}


@pytest.mark.parametrize("what", BAD)
def test_what_is_wrong_in_a_suite_is_told_with_its_line(what, tmp_path):
    old, new, *words = BAD[what]
    assert old in TEXT
    with pytest.raises(SuiteError) as error:
        read_suite(str(written(tmp_path, TEXT.replace(old, new))))
    for word in words:
        assert word in str(error.value), error.value


def test_a_suite_is_driven_judged_and_goes_on_where_it_was(tmp_path, monkeypatch, capsys):
    arguments = ("suite", written(tmp_path), "--out", tmp_path / "out", "--json")
    code, out, _ = ion(monkeypatch, capsys, *arguments, "--junit", tmp_path / "verdicts.xml")
    *drives, told = lines(out)
    assert code == 1
    assert [drive["failed"] for drive in drives] == [[], ["outcome"], []]
    assert (told["episodes"], told["failed"]) == (3, 1)
    assert told["failures"][0]["case"] == "hopeless 0"
    assert Path(told["failures"][0]["log"]).exists()
    assert drives[0]["log"] is None

    root = ElementTree.parse(tmp_path / "verdicts.xml").getroot()
    assert (root.get("tests"), root.get("failures"), root.get("errors")) == ("6", "1", "0")

    kept = tmp_path / "out" / "mine" / "results.jsonl"
    whole = kept.read_text()
    kept.write_text("".join(whole.splitlines(keepends=True)[:2]) + whole.splitlines()[2][:80])
    _, out, _ = ion(monkeypatch, capsys, *arguments)
    again, told = lines(out)
    assert again["digest"] == drives[2]["digest"]
    assert told["episodes"] == 3


def test_two_processes_give_the_same(tmp_path, monkeypatch, capsys):
    path, found = written(tmp_path), []
    for jobs in (1, 2):
        folder = tmp_path / str(jobs)
        arguments = ("suite", path, "--out", folder, "--json", "--jobs", jobs)
        *drives, _ = lines(ion(monkeypatch, capsys, *arguments)[1])
        found.append(sorted((drive["case"], drive["digest"]) for drive in drives))
    assert found[0] == found[1]


def test_results_of_another_scenario_or_code_do_not_hold(tmp_path):
    cases = cases_of(read_suite(str(written(tmp_path))))
    results = Results(tmp_path, cases, "code")
    verdicts = [{"figure": "contacts", "passed": True}]
    results.add(0, {"outcome": "timeout", "verdicts": verdicts, "log": None})
    assert Results(tmp_path, cases, "code").missing == [1, 2]
    assert Results(tmp_path, cases, "another").missing == [0, 1, 2]
    assert Results(tmp_path, cases, "code").missing == [0, 1, 2]


def test_what_broke_or_was_interrupted_is_driven_again(tmp_path):
    cases = cases_of(read_suite(str(written(tmp_path))))
    results = Results(tmp_path, cases, "code")
    results.add(0, {"outcome": "interrupted"})
    assert results.missing == [0, 1, 2]
    assert results.add(1, {"outcome": "error", "message": "it broke"})["failed"] == ["error"]
    assert results.missing == [0, 2]
    assert Results(tmp_path, cases, "code").missing == [0, 1, 2]


def test_a_mutant_is_caught_by_a_verdict_that_the_healthy_pass():
    runs = read_suite("smoke").runs
    turn = next(run.scenario for run in runs if run.scenario.name == "sharp_turn")
    number = list(MUTANTS).index("reversed_steering")
    caught = Drives([Case(turn, 0)], frozenset())(number)
    assert caught["outcome"] == "caught"
    assert caught["by"]["case"] == "sharp_turn 0"
    unfit = frozenset(verdict_of(Case(turn, 0), figure) for figure in turn.verdicts)
    assert Drives([Case(turn, 0)], unfit)(number)["outcome"] == "escaped"


def test_wrong_arguments(tmp_path, monkeypatch, capsys):
    path = written(tmp_path)
    assert "smoke" in refused(monkeypatch, capsys, "suite", "smok")
    assert "cannot be read" in refused(monkeypatch, capsys, "suite", tmp_path / "no.toml")
    assert "--jobs 0" in refused(monkeypatch, capsys, "suite", path, "--jobs", 0)
    assert "--seeds 'x'" in refused(monkeypatch, capsys, "suite", path, "--seeds", "x")
    assert "--junit" in refused(monkeypatch, capsys, "suite", path, "--junit", "/no/where.xml")


def result(case, passed=True, **figures):
    verdicts = [{"figure": "contacts", "passed": passed, "value": 0, "expected": "0"}]
    return {"case": case, "verdicts": verdicts, "failed": [] if passed else ["contacts"], **figures}


def test_a_baseline_tells_verdicts_that_turned_and_figures_that_moved_beyond_chance():
    rng = np.random.default_rng(0)
    then = {f"a {k}": result(f"a {k}", v=float(k), noise=float(rng.normal())) for k in range(10)}
    now = [result(f"a {k}", k != 3, v=k + 0.1, noise=float(rng.normal())) for k in range(10)]
    found = changes(now, then)
    assert [(v.case, v.figure) for v in found.regressions] == [("a 3", "contacts")]
    assert [(f.run, f.figure, f.seeds) for f in found.moved] == [("a", "v", 10)]
    assert found.moved[0].low == pytest.approx(0.1)
    back = changes(list(then.values()), {r["case"]: r for r in now})
    assert not back.regressions
    assert len(back.turned) == 1
    assert changes(list(then.values()), then) == ([], [], [])


def test_few_seeds_say_nothing_of_figures():
    then = {f"a {k}": result(f"a {k}", v=0.0) for k in range(3)}
    assert changes([result(f"a {k}", v=1.0) for k in range(3)], then).moved == []


def test_against_a_baseline_only_what_got_worse_fails(tmp_path, monkeypatch, capsys):
    words = ("suite", written(tmp_path), "--out", tmp_path / "out")
    assert ion(monkeypatch, capsys, *words)[0] == 1
    baseline = tmp_path / "baseline.jsonl"
    kept = tmp_path / "out" / "mine" / "results.jsonl"
    baseline.write_text(kept.read_text())
    code, out, _ = ion(monkeypatch, capsys, *words, "--baseline", baseline, "--json")
    assert code == 0
    assert lines(out)[-1]["other_digests"] == []
    failed, passed = ('"figure": "outcome", "passed": ' + word for word in ("false", "true"))
    better = baseline.read_text().replace(failed, passed)
    baseline.write_text(better)
    code, out, _ = ion(monkeypatch, capsys, *words, "--baseline", baseline)
    assert code == 1
    assert "FAILS NOW  hopeless 0: outcome" in out
    page = (tmp_path / "out" / "mine" / "report.html").read_text()
    assert "hopeless_seed0.mcap" in page
    assert "--run hopeless --seeds 0" in page
    baseline.write_text("no results\n")
    assert "--baseline" in refused(monkeypatch, capsys, *words, "--baseline", baseline)


def test_one_run_alone(tmp_path, monkeypatch, capsys):
    words = ("suite", written(tmp_path), "--out", tmp_path, "--json", "--run", "hopeless")
    *drives, _ = lines(ion(monkeypatch, capsys, *words)[1])
    assert [drive["case"] for drive in drives] == ["hopeless 0"]
    assert "hopeless" in refused(monkeypatch, capsys, *words[:-1], "hope")
