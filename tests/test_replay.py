"""A replay gives what the tape says, and tells where it does not."""

from dataclasses import replace
from functools import partial

import pytest

from nav.messages import ActuatorTargets, Decision, LidarScan, VehicleState
from nav.navigator import IonNavigator
from nav.route import rddf
from scenarios.difference import difference
from scenarios.episode import Episode
from scenarios.parameter_files import parameter_texts
from scenarios.processor import fingerprint
from scenarios.random_field.course import build
from scenarios.replay import Tick, navigator_of, replay, tolerance
from tape.errors import TapeError
from tape.reader import attachments, span_ns
from tape.record import record
from tape.writer import TapeWriter

TICKS = 300


@pytest.fixture(scope="module")
def course():
    return build(0)


@pytest.fixture(scope="module")
def tape(course, tmp_path_factory):
    """Six seconds of the random field."""
    path = tmp_path_factory.mktemp("replay") / "field.mcap"
    attached = {course.route_name: course.route_text, **parameter_texts(course.vehicle)}
    episode = Episode(course, 0)
    with TapeWriter(path, attached, fingerprint() | {"vehicle": course.vehicle}) as writer:
        for _ in range(TICKS):
            for item in episode.tick():
                writer.write(item)
    return path


def test_the_replay_equals_the_log(tape):
    assert tolerance(tape) == 0.0
    ticks = list(replay(tape, navigator_of(tape)))
    assert len(ticks) == TICKS
    assert [t.time_ns for t in ticks] == [20_000_000 * (k + 1) for k in range(TICKS)]
    assert {difference(tick) for tick in ticks} == {""}
    assert any(isinstance(r, Decision) for tick in ticks for r in tick.outputs.reports)
    assert any(isinstance(m, LidarScan) for tick in ticks for m in tick.messages)


def test_another_parameter_is_told_with_the_field_that_differs(tape):
    p = navigator_of(tape).parameters
    slow = replace(p.planning.speed, cap_mps=3.0)
    p = replace(p, planning=replace(p.planning, speed=slow))
    other = IonNavigator(p, _route(tape))
    said = [d for tick in replay(tape, other) if (d := difference(tick))]
    assert "on the tape" in said[0]
    assert any("V0_mps is 8.0" in d or "speed_mps" in d for d in said)


def _route(tape):
    name = "random_field.rddf"
    return rddf.parse(attachments(tape)[name].decode(), name)


def test_a_difference_within_the_tolerance_is_none(tape):
    *_, tick = replay(tape, navigator_of(tape))
    outputs = tick.outputs
    assert isinstance(outputs.targets, ActuatorTargets)
    moved = replace(outputs.targets, steering_rad=outputs.targets.steering_rad + 1e-12)
    other = tick._replace(outputs=outputs._replace(targets=moved))
    assert "steering_rad" in difference(other)
    assert difference(other, 1e-9) == ""


def test_a_missing_report_is_told(tape):
    tick = [t for t in replay(tape, navigator_of(tape)) if len(t.logged) > 1][-1]
    fewer = Tick(*tick[:3], tick.logged[-1:])
    assert difference(fewer).startswith("the tape has ActuatorTargets, the replay EgoEstimate")


def test_another_machine_is_compared_to_a_tolerance(tmp_path):
    path = tmp_path / "other.mcap"
    with TapeWriter(path, {}, fingerprint() | {"numpy": "1.0"}):
        pass
    assert tolerance(path) == 1e-9


@pytest.mark.parametrize(
    ("attached", "expected"),
    [({}, "no route"), ({"a.rddf": ""}, "missing; a full set"), (None, "waypoints")],
)
def test_what_makes_no_navigator_is_refused_with_the_tape_s_name(attached, expected, tmp_path):
    path = tmp_path / "run.mcap"
    with TapeWriter(path, {"a.rddf": "", **parameter_texts()} if attached is None else attached):
        pass
    with pytest.raises(TapeError, match=expected) as refused:
        navigator_of(path)
    assert str(path) in str(refused.value)


def test_a_cut_tape_is_replayed_as_far_as_it_goes(tape, tmp_path):
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(tape.read_bytes()[: tape.stat().st_size * 2 // 3])
    ticks = list(replay(cut, navigator_of(cut)))
    assert 50 < len(ticks) < TICKS
    assert {difference(tick) for tick in ticks} == {""}
    assert span_ns(cut)[1] >= ticks[-1].time_ns


def test_the_span_of_a_tape(tape, tmp_path):
    assert span_ns(tape) == (20_000_000, 20_000_000 * TICKS)
    with TapeWriter(tmp_path / "empty.mcap"):
        pass
    with pytest.raises(TapeError, match="empty"):
        span_ns(tmp_path / "empty.mcap")


def test_messages_after_the_last_targets_are_left_out(tape, course, tmp_path):
    path = tmp_path / "open.mcap"
    episode = Episode(course, 0)
    attached = {course.route_name: course.route_text, **parameter_texts(course.vehicle)}
    with TapeWriter(path, attached, {"vehicle": course.vehicle}) as writer:
        for _ in range(2):
            records = episode.tick()
            for item in records:
                writer.write(item)
        heard = [r.message for r in records if isinstance(r.message, VehicleState)]
        write = partial(record, 60_000_000)
        writer.write(write(heard[0]))
    assert len(list(replay(path, navigator_of(path)))) == 2
