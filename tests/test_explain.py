"""`ion explain`: its numbers are those of the decision, and what cannot be answered is refused."""

import json
from dataclasses import replace

import numpy as np
import pytest
from test_cli import ion, refused

from ion.courses import scenario_source
from ion.explain.asked import decision_at
from ion.explain.explanation import explanation_of
from ion.explain.numbers import numbers
from ion.explain.rule_panels import strongest
from ion.explain.words import known
from ion.job import Job
from nav.fusion.health import Health
from nav.messages import Decision
from nav.planning.focus import angle_between
from scenarios.dead_end.course import build as dead_end
from scenarios.episode import Episode
from scenarios.random_field.course import build as random_field
from scenarios.run import run
from tape.reader import read

KEYS = """
theta_rad distance_real_m distance_safe_m deduction_m candidates_real candidates_safe goal_rad
heading_rad decision_real_rad decision_safe_rad decision_rad selected speed_rules speed_mps state
reason
"""
CURVES = KEYS.split()[:6]
SEED = 3
"""Both main states within twelve seconds."""


def until(time_s):
    def stop(episode, records):
        if episode.time_s >= time_s:
            raise KeyboardInterrupt

    return stop


@pytest.fixture(scope="module")
def tape(tmp_path_factory):
    """Twelve seconds of the random field, with circles on the way."""
    folder = tmp_path_factory.mktemp("explain")
    job = Job(scenario_source("random_field"), folder, log="inputs")
    return job.drive(SEED, [until(12.0)])["log"]


@pytest.fixture(scope="module")
def decisions(tape):
    return [r for r in read(tape) if isinstance(r.message, Decision)]


@pytest.fixture(scope="module")
def avoiding(decisions):
    """When Obstacle Avoidance decided, neither first nor last, [s]."""
    times = [r.delivery_ns * 1e-9 for r in decisions if r.message.selected]
    assert len(times) > 10
    return times[5]


def answer(tape, at_s):
    return decision_at(tape, at_s, lambda seconds: None)


def test_json_has_the_keys_and_the_curves_have_one_length(tape, avoiding, monkeypatch, capsys):
    code, out, err = ion(monkeypatch, capsys, "explain", tape, "--at", avoiding, "--json")
    assert code == 0, err
    found = json.loads(out)
    assert [key for key in KEYS.split() if key not in found] == []
    assert {len(found[key]) for key in CURVES} == {121}
    assert found["picture"] is None
    assert found["replay_difference"] == ""


def test_the_numbers_satisfy_the_equations(tape, avoiding):
    """(6.5), (6.6) and Table 6.1, worked out again from the arrays."""
    n = numbers(answer(tape, avoiding))
    theta = np.array(n["theta_rad"])
    for word in ("real", "safe"):
        adjusted = np.array(n[f"distance_{word}_m"]) - n["deduction_m"]
        among = adjusted > n[f"criterion_{word}_m"]
        assert among.tolist() == n[f"candidates_{word}"]
        off = np.where(among, angle_between(theta, n["goal_rad"]), np.inf)
        chosen = float(angle_between(n[f"decision_{word}_rad"], n["goal_rad"]))
        assert chosen == pytest.approx(off.min(), abs=1e-6)
    assert n["decision_rad"] == n[f"decision_{n['selected']}_rad"]
    assert strongest(n["select_rules"], n["selected"]).endswith(n["selected"])
    assert n["speed_mps"] == min(n["speed_terms_mps"].values())
    assert max(n["speed_rules"]["A"].values()) > 0.0


def test_every_decision_in_force_is_the_logged_one(tape):
    """What `consider` says afterwards is what the controller had decided."""
    episode, seen = Episode(random_field(SEED), SEED), 0

    def watch(episode, records):
        nonlocal seen
        why = explanation_of(episode.navigator)
        if any(isinstance(r.message, Decision) and r.message.selected for r in records):
            seen += 1
            assert why.in_force
            assert why.considered.decision.theta_D == episode.decision.decision_rad
            assert why.considered.decision.selected == episode.decision.selected

    run(episode, watches=[watch, until(12.0)])
    assert seen > 10


def test_the_last_decision_until_then_is_explained(tape, decisions):
    item = decisions[40]
    at_s = item.delivery_ns * 1e-9
    for late in (0.0, 0.07):
        found = answer(tape, at_s + late)
        assert found.explanation.situation.time_ns == item.message.time_ns
        assert found.explanation.plan.speed_mps == item.message.speed_mps
        assert (found.difference, found.first_difference) == ("", "")


def test_on_the_smooth_path_the_controller_says_what_it_would_do(
    tape, decisions, monkeypatch, capsys
):
    kept = next(r for r in decisions if r.message.state == "path_point_keeping")
    at_s = kept.delivery_ns * 1e-9
    n = numbers(answer(tape, at_s))
    assert not n["in_force"]
    assert len(n["theta_rad"]) == 121
    assert n["path_direction_rad"] == kept.message.decision_rad
    code, out, _ = ion(monkeypatch, capsys, "explain", tape, "--at", at_s)
    assert code == 0
    assert "would be" in out


def test_other_states_say_what_there_is():
    episode, states = Episode(dead_end(0), 0), dict[str, dict]()

    def watch(episode, records):
        if episode.state not in states and (why := explanation_of(episode.navigator)):
            states[why.state] = numbers_of(why)
        if "robotic_operations" in states or "rollback" in states:
            raise KeyboardInterrupt

    run(episode, watches=[watch, until(60.0)])
    other = next(n for s, n in states.items() if s in ("robotic_operations", "rollback"))
    assert other["theta_rad"] is None
    assert other["speed_rules"] is None
    assert isinstance(other["decision_rad"], float)
    assert other["reason"]
    json.dumps(other, allow_nan=False)


def numbers_of(why):
    from ion.explain.asked import Answer

    return numbers(Answer(why, "", ""))


def test_the_health_of_the_ego_state_is_told():
    """A drive whose fixes are refused, and whose bumper scanner is silent."""
    episode = Episode(dead_end(SEED), SEED)
    for _ in range(150):
        episode.tick()
    navigator = episode.navigator
    now_ns = navigator.high_level.situation.time_ns
    navigator.ego.filter.refused_since_ns["gps position"] = now_ns - 1_500_000_000
    why = explanation_of(navigator)
    why = replace(why, situation=replace(why.situation, health=Health(("lidar_bumper",))))
    assert known(why).endswith("gps position refused for 1.5 s; lidar_bumper failed")
    found = numbers_of(why)
    assert found["refused_s"] == {"gps position": 1.5}
    assert found["sensors_failed"] == ["lidar_bumper"]
    assert 0.0 < found["position_sd_m"] < 0.2


def test_a_table_and_a_picture_beside_the_tape(tape, avoiding, monkeypatch, capsys):
    at_s = round(avoiding, 2)
    code, out, err = ion(monkeypatch, capsys, "explain", tape, "--at", at_s)
    assert code == 0, err
    path = tape.replace(".mcap", f"_at{at_s:g}.png")
    assert out.rstrip().endswith(f"picture: {path}")
    assert "equals the logged one" in out
    assert "theta_D" in out
    assert "m an axis" in out
    assert "the last fix 0." in out
    with open(path, "rb") as file:
        assert file.read(4)[1:] == b"PNG"


def test_out_says_where(tape, avoiding, tmp_path, monkeypatch, capsys):
    path = tmp_path / "new" / "why.png"
    arguments = ("explain", tape, "--at", avoiding, "--json", "--out", path)
    code, out, _ = ion(monkeypatch, capsys, *arguments)
    assert code == 0
    assert json.loads(out)["picture"] == str(path)
    assert path.stat().st_size > 50_000


def test_a_navigator_that_decides_otherwise_is_told(tape, avoiding, monkeypatch, capsys):
    from ion.explain import asked

    honest = asked.navigator_of

    def turned(log):
        navigator = honest(log)
        navigator.high_level.V0 *= 0.5
        return navigator

    monkeypatch.setattr(asked, "navigator_of", turned)
    found = answer(tape, avoiding)
    assert "on the tape" in found.first_difference
    code, out, _ = ion(monkeypatch, capsys, "explain", tape, "--at", avoiding)
    assert code == 0
    assert "DIFFERS" in out or "differed before" in out


@pytest.mark.parametrize(
    ("at_s", "expected"),
    [("99", "ends at 12"), ("0.1", "the first decision"), ("nan", "ends at"), ("-1", "first")],
)
def test_a_time_without_a_decision_is_refused(at_s, expected, tape, monkeypatch, capsys):
    assert expected in refused(monkeypatch, capsys, "explain", tape, "--at", at_s)


def test_what_is_no_tape_is_refused(tmp_path, monkeypatch, capsys):
    missing, foreign = tmp_path / "no.mcap", tmp_path / "text.mcap"
    foreign.write_text("once upon a time")
    said = refused(monkeypatch, capsys, "explain", missing, "--at", 3)
    assert "No such file" in said
    assert "not a tape" in refused(monkeypatch, capsys, "explain", foreign, "--at", 3)


def test_a_tape_without_scans_is_refused_unless_none_were_heard(tmp_path, monkeypatch, capsys):
    for ablate, log in (((), "light"), (("no-lidar",), "inputs")):
        job = Job(scenario_source("random_field"), tmp_path, log=log, ablate=ablate)
        tape = job.drive(0, [until(1.5)])["log"]
        if ablate:
            assert answer(tape, 1.4).difference == ""
        else:
            said = refused(monkeypatch, capsys, "explain", tape, "--at", 1.4)
            assert "no LIDAR scans" in said


def test_a_picture_that_cannot_be_written_is_named(tape, tmp_path, monkeypatch, capsys):
    (tmp_path / "file").touch()
    path = tmp_path / "file" / "why.png"
    said = refused(monkeypatch, capsys, "explain", tape, "--at", 5, "--out", path)
    assert str(path) in said
