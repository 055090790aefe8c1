"""`ion replay`: identical with unchanged code, and what moved where parameters have."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from test_cli import ion, refused
from test_explain import until

from ion.courses import scenario_source
from ion.job import Job
from ion.replay import command
from ion.replay.comparison import compare
from ion.replay.picture import both, waveform
from nav.messages import Decision
from scenarios.difference import difference, differences
from scenarios.parameter_files import parameter_texts
from scenarios.replay import navigator_of, replay
from tape.reader import read

SEED, SECONDS = 3, 12.0
KEYS = ["log", "ticks", "identical", "first_difference", "platform", "fields", "picture"]
FIRST = ["tick", "time_s", "field", "index", "logged", "now"]


def driven(folder, log="inputs", seconds=SECONDS, seed=SEED):
    job = Job(scenario_source("random_field"), folder, log=log)
    return job.drive(seed, [until(seconds)])["log"]


@pytest.fixture(scope="module")
def tape(tmp_path_factory):
    """Twelve seconds of the random field: both main states."""
    return driven(tmp_path_factory.mktemp("replayed"))


@pytest.fixture
def moved(tmp_path):
    """A folder with one parameter file: (6.8) caps the speed lower."""
    return folder_with(tmp_path / "slow", "dubins.toml", "cap_mps = 8.0", "cap_mps = 1.5")


def folder_with(folder, name, old, new):
    text = parameter_texts("dubins")[name]
    assert old in text
    folder.mkdir()
    (folder / name).write_text(text.replace(old, new))
    (folder / "notes.txt").write_text("why")
    return folder


def test_unchanged_it_is_identical_to_the_bit(tape, monkeypatch, capsys):
    code, out, _ = ion(monkeypatch, capsys, "replay", tape)
    assert code == 0
    assert out == f"{tape}: identical to the bit: 600 ticks\n"


def test_json_has_these_keys(tape, monkeypatch, capsys):
    code, out, _ = ion(monkeypatch, capsys, "replay", tape, "--json")
    found = json.loads(out)
    assert code == 0
    assert list(found) == KEYS
    assert (found["ticks"], found["identical"], found["first_difference"]) == (600, True, None)
    assert found["platform"] == {"same": True, "tolerance": 0.0, "differs": {}}
    assert found["fields"] == {}


def test_a_moved_parameter_is_told_with_tick_and_field(tape, moved, monkeypatch, capsys):
    code, out, _ = ion(monkeypatch, capsys, "replay", tape, "--parameters", moved, "--json")
    found = json.loads(out)
    first = found["first_difference"]
    assert code == 1
    assert not found["identical"]
    assert list(first) == FIRST
    decided = [r for r in read(tape) if isinstance(r.message, Decision)]
    item = next(r for r in decided if r.message.speed_mps > 1.5)
    assert first["time_s"] == pytest.approx(item.delivery_ns * 1e-9)
    assert first["tick"] == round(first["time_s"] / 0.02) - 1
    assert first["field"] in ("FollowPath.speed_mps", "Decision.speed_mps", "Decision.V0_mps")
    assert first["logged"] > first["now"]
    assert found["ticks"] == 600
    assert "ActuatorTargets.throttle" in found["fields"]
    speed = found["fields"]["Decision.speed_mps"]
    assert speed["ticks"] > 5
    assert speed["most"] > 0.1


def test_a_moved_threshold_is_told(tape, tmp_path, monkeypatch, capsys):
    """What a direction must have ahead of it, (6.5): fewer are candidates."""
    old, new = "safe_m = 16.0", "safe_m = 25.0"
    folder = folder_with(tmp_path / "criterion", "steering.toml", old, new)
    code, out, _ = ion(monkeypatch, capsys, "replay", tape, "--parameters", folder)
    assert code == 1
    first = r"differs first at tick 3\d\d, t = 7\.\d\d s: Decision\.decision_rad was -?\d"
    assert re.search(first, out)


def test_people_get_a_sentence_a_table_and_a_picture(tape, moved, tmp_path, monkeypatch, capsys):
    picture = tmp_path / "new" / "moved.png"
    asked = ("replay", tape, "--parameters", moved, "--out", picture)
    code, out, _ = ion(monkeypatch, capsys, *asked)
    assert code == 1
    assert ": differs first at tick" in out.splitlines()[0]
    assert "What moved" in out
    assert out.endswith(f"picture: {picture}\n")
    assert picture.read_bytes()[1:4] == b"PNG"


def test_several_tapes_have_a_line_each_and_a_bad_one_says_so(tape, tmp_path, monkeypatch, capsys):
    light = driven(tmp_path, "light", 1.0)
    asked = ("replay", tape, light, "--json", "--jobs", 2)
    code, out, err = ion(monkeypatch, capsys, *asked)
    found = {line["log"]: line for line in map(json.loads, out.splitlines())}
    assert code == 2
    assert found[tape]["identical"]
    assert found[light]["outcome"] == "error"
    assert "no LIDAR scans" in found[light]["message"]
    assert "2 of 2 tapes" in err


def test_a_cut_tape_is_replayed_to_where_it_ends(tape, tmp_path, monkeypatch, capsys):
    cut = tmp_path / "cut.mcap"
    with open(tape, "rb") as file:
        content = file.read()
    cut.write_bytes(content[: len(content) * 2 // 3])
    code, out, _ = ion(monkeypatch, capsys, "replay", cut, "--json")
    found = json.loads(out)
    assert code == 0
    assert found["identical"]
    assert 50 < found["ticks"] < 600


def test_what_cannot_be_replayed_is_refused_in_one_line(tape, tmp_path, monkeypatch, capsys):
    foreign = tmp_path / "text.mcap"
    foreign.write_text("once upon a time")
    assert "not a tape" in refused(monkeypatch, capsys, "replay", foreign)
    assert "No such file" in refused(monkeypatch, capsys, "replay", tmp_path / "none.mcap")
    light = driven(tmp_path, "light", 1.0)
    assert "no LIDAR scans" in refused(monkeypatch, capsys, "replay", light)
    assert "expected a tape" in refused(monkeypatch, capsys, "replay")
    assert "--jobs 0" in refused(monkeypatch, capsys, "replay", tape, "--jobs", 0)
    two = ("replay", tape, tape, "--out", tmp_path / "a.png")
    assert "expected one tape" in refused(monkeypatch, capsys, *two)


def test_a_folder_of_parameters_must_fit_the_vehicle(tape, tmp_path, monkeypatch, capsys):
    def said():
        return refused(monkeypatch, capsys, "replay", tape, "--parameters", tmp_path)

    assert "no TOML file is there" in said()
    (tmp_path / "steering.toml").write_text("colour = 'blue'")
    assert "steering.toml" in said()
    (tmp_path / "stearing.toml").write_text("")
    assert "stearing.toml: no parameter file of" in said()
    assert "steering.toml" in said()


def test_another_platform_is_compared_to_a_tolerance_and_says_so(tape, monkeypatch, capsys):
    elsewhere = {"numpy": ("1.0", "2.0")}
    monkeypatch.setattr(command, "unlike", lambda log: elsewhere)
    monkeypatch.setattr(command, "tolerance", lambda log: 1e-9)
    code, out, _ = ion(monkeypatch, capsys, "replay", tape)
    assert code == 0
    assert "identical to 1e-09: 600 ticks" in out
    assert "of another platform: numpy 1.0, here 2.0" in out


def test_ctrl_c_ends_it_without_a_traceback(tape, monkeypatch, capsys):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "compare", interrupt)
    code, out, err = ion(monkeypatch, capsys, "replay", tape)
    assert (code, out) == (130, "")
    assert err.endswith("ion: interrupted\n")


def decided(tape):
    """A tick with a decision."""
    return [t for t in replay(tape, navigator_of(tape)) if len(t.logged) > 3][-1]


def test_every_field_that_differs_is_found_and_the_text_is_of_the_first(tape):
    tick = decided(tape)
    ego, path, *others = tick.outputs.reports
    aside = path.pathpoint_m.copy()
    aside[3, 1] += 0.25
    aside[4, 0] -= 0.5
    reports = (ego, replace(path, pathpoint_m=aside, speed_mps=9.0), *others)
    found = differences(tick._replace(outputs=tick.outputs._replace(reports=reports)))
    assert [each.field for each in found] == ["FollowPath.pathpoint_m", "FollowPath.speed_mps"]
    assert found[0].index == (3, 1)
    assert found[0].now - found[0].logged == pytest.approx(0.25)
    assert found[0].most == pytest.approx(0.5)
    assert str(found[0]).startswith("FollowPath.pathpoint_m[3, 1] is ")


def test_a_zero_s_sign_and_a_shape_are_differences(tape):
    tick = decided(tape)
    zero = replace(tick.outputs.targets, brake=-0.0, throttle=0.0)
    logged = tuple(
        r._replace(message=replace(zero, brake=0.0), payload=b"") if r is tick.logged[-1] else r
        for r in tick.logged
    )
    there = tick._replace(logged=logged, outputs=tick.outputs._replace(targets=zero))
    assert difference(there) == "ActuatorTargets.brake is 0.0 on the tape, -0.0 in the replay"
    assert difference(there, 1e-9) == ""
    ego, path, *others = tick.outputs.reports
    short = replace(path, pathpoint_m=np.zeros((9, 2)))
    shorter = tick.outputs._replace(reports=(ego, short, *others))
    assert "10 x 2 numbers on the tape, 9 x 2" in difference(tick._replace(outputs=shorter))


def test_after_a_difference_all_ticks_are_kept_for_the_waveform(tape):
    ticks = list(replay(tape, navigator_of(tape)))
    late = ticks[200]
    turned = replace(late.outputs.targets, steering_rad=1.0)
    ticks[200] = late._replace(outputs=late.outputs._replace(targets=turned))
    found = compare(ticks, 0.0, lambda tick: None)
    assert found.first.tick == 200
    assert list(found.moved) == ["ActuatorTargets.steering_rad"]
    assert len(found.kept) == 100 + 400
    curve = waveform(both(list(found.kept)), "ActuatorTargets.steering_rad")
    assert sum(a != b for a, b in zip(curve.logged, curve.now, strict=True)) == 1
