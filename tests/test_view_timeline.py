"""What `ion view` knows of a tape at a time, and how it is put into words and pictures."""

import shutil
import socket
from pathlib import Path

import numpy as np
import pytest

from ion.errors import UsageError
from ion.recorded import recorded
from ion.view.cameras import CAMERAS
from ion.view.marks import events, following, preceding, replannings
from ion.view.places import Places, true_pose
from ion.view.player import Player
from ion.view.sensor_scene import boundary_edges
from ion.view.series import Columns
from ion.view.server import free_port
from ion.view.shapes import box, cylinder, edges
from ion.view.timeline import Timeline
from ion.view.words import sentence
from nav.messages import Decision, EgoEstimate, LidarScan
from nav.parameters import parameters_from
from tape.reader import read
from tape.truth import TRUTH

AT_S = 16.0


@pytest.fixture(scope="module")
def timeline(short_tape):
    found = Timeline(Path(short_tape))
    found.read()
    return found


@pytest.fixture(scope="module")
def drive(short_tape):
    return recorded(Path(short_tape))


def newest(log, kind, prefix="/tape/"):
    found = [r for r in read(log, prefix) if isinstance(r.message, kind)]
    return [r.message for r in found if r.delivery_ns <= AT_S * 1e9][-1]


def test_a_moment_is_the_newest_of_each_kind(timeline, short_tape):
    moment = timeline.at(AT_S)
    assert moment.ego.time_ns == newest(short_tape, EgoEstimate).time_ns
    assert moment.decision.time_ns == newest(short_tape, Decision).time_ns
    assert moment.truth.time_ns == newest(short_tape, object, TRUTH).time_ns


def test_scans_are_thinned_to_five_a_second_and_not_rounded(timeline, short_tape):
    times = timeline.scans["lidar_roof"].time_s
    assert np.diff(times).min() > 0.18
    assert len(times) == pytest.approx(5.0 * timeline.end_s, rel=0.1)
    shown = timeline.at(AT_S).scans["lidar_roof"]
    logged = [r.message for r in read(short_tape) if isinstance(r.message, LidarScan)]
    same = [m for m in logged if m.sensor == "lidar_roof" and m.time_ns == shown.time_ns]
    np.testing.assert_array_equal(same[0].range_m, shown.range_m)


def test_before_the_first_message_there_is_nothing(timeline):
    moment = timeline.at(0.0)
    assert (moment.ego, moment.truth, moment.decision, moment.scans) == (None, None, None, {})
    assert "no decision yet" in sentence(moment)


def test_wheels_have_rolled_as_far_as_the_vehicle_went(timeline):
    true = timeline.true.between(0.0, AT_S)[:, 1:3]
    way_m = np.hypot(*np.diff(true, axis=0).T).sum()
    assert np.mean(timeline.at(AT_S).rolled_m) == pytest.approx(way_m, rel=0.05)


def test_words_say_state_since_when_and_why(timeline, drive):
    entered = next(e for e in drive.events if e.text.startswith("obstacle avoidance"))
    said = sentence(timeline.at(AT_S))
    assert f"**Obstacle Avoidance** since {entered.time_s:.1f} s: obstacle on the" in said
    assert "Selected the" in said


def test_events_are_those_of_the_drive(timeline, drive):
    assert [tuple(m) for m in events(drive, timeline)] == [
        (pytest.approx(e.time_s), f"end: {e.text}" if e.kind == "end" else e.text)
        for e in drive.events
    ]


def test_jumping_goes_on_from_where_one_stands(timeline, drive):
    marks = events(drive, timeline)
    second = following(marks, marks[0].time_s)
    assert second == marks[1]
    assert preceding(marks, second.time_s) == marks[0]
    assert following(marks, marks[-1].time_s) is None
    assert preceding(marks, marks[0].time_s) is None
    assert all(mark.text.startswith("new path: ") for mark in replannings(timeline))


def test_steps_go_from_decision_to_decision(timeline):
    after = timeline.decision.next_s(AT_S)
    assert AT_S < after <= AT_S + 0.1001
    assert timeline.decision.previous_s(after) == pytest.approx(after - 0.1)


def test_a_cut_tape_shows_what_there_is(short_tape, tmp_path):
    cut = tmp_path / "cut.mcap"
    shutil.copy(short_tape, cut)
    with open(cut, "r+b") as file:
        file.truncate(cut.stat().st_size // 2)
    timeline = Timeline(cut)
    timeline.read()
    assert timeline.complete
    assert timeline.trouble == ""
    assert 4.0 < timeline.end_s < 14.0
    assert timeline.at(timeline.end_s).truth is not None


def test_damage_in_the_middle_is_told(short_tape, tmp_path):
    damaged, content = tmp_path / "damaged.mcap", bytearray(Path(short_tape).read_bytes())
    middle = content.index(b"\x28\xb5\x2f\xfd", len(content) // 2)  # a zstd frame begins
    content[middle + 20] ^= 0x55
    damaged.write_bytes(content)
    timeline = Timeline(damaged)
    timeline.read()
    assert "damaged" in timeline.trouble
    assert timeline.end_s > 1.0


def test_estimate_and_truth_are_drawn_at_one_place(timeline, drive):
    places, moment = Places(drive.course()), timeline.at(AT_S)
    believed, true = places.estimated(moment.ego), true_pose(moment.truth)
    np.testing.assert_allclose(believed.position_m, true.position_m, atol=1.0)
    np.testing.assert_allclose(believed.axes, true.axes, atol=0.1)


def test_cameras_look_at_what_lies_ahead_of_the_vehicle(timeline):
    pose = true_pose(timeline.at(AT_S).truth)
    for place in CAMERAS.values():
        eye, at = pose.to_vehicle(np.stack(place(pose)))
        assert at[0] > 0.0
        assert eye[2] > 1.0


def test_safe_boundary_is_around_the_real_one(drive):
    parameters = parameters_from(drive.files)
    foot = parameters.planning.footprint
    real, safe = boundary_edges(np.array([[10.1, 20.1]]), parameters)
    for segments, radius_m in ((real, foot.real_radius_m), (safe, foot.safe_radius_m)):
        far = np.hypot(*(segments.reshape(-1, 2) - [10.1, 20.1]).T)
        np.testing.assert_allclose(far, radius_m, atol=0.3)


def test_edges_go_once_around_an_area():
    inside = np.zeros((4, 5), bool)
    inside[1:3, 1:4] = True
    segments = edges(inside, np.array([100.0, 200.0]), 0.5)
    assert len(segments) == 2 * (2 + 3)
    np.testing.assert_allclose(segments.reshape(-1, 2).min(axis=0), [100.5, 200.5])
    np.testing.assert_allclose(segments.reshape(-1, 2).max(axis=0), [102.0, 201.5])


@pytest.mark.parametrize("mesh", [box(), cylinder()])
def test_faces_look_outwards(mesh):
    a, b, c = (mesh.vertex_m[mesh.face[:, k]] for k in range(3))
    outwards = np.einsum("ij,ij->i", np.cross(b - a, c - a), (a + b + c) / 3.0)
    assert (outwards > 0.0).all()


def test_columns_give_a_span_with_both_ends():
    columns = Columns(1)
    for k in range(5):
        columns.append(0.5 * k, float(k))
    np.testing.assert_array_equal(columns.between(0.5, 1.5)[:, 1], [1.0, 2.0, 3.0])
    assert columns.between(9.0, 10.0).shape == (0, 2)
    assert columns.at(1.2) == (2.0,)


def test_player_stops_at_the_end_and_waits_where_more_will_come():
    player = Player(speed=2.0)
    player.play(10.0)
    player.advance(3.0, 10.0, complete=True)
    assert (player.time_s, player.playing) == (6.0, True)
    player.advance(3.0, 10.0, complete=False)
    assert (player.time_s, player.playing) == (10.0, True)
    player.advance(0.1, 10.0, complete=True)
    assert not player.playing
    player.play(10.0)
    assert player.time_s == 0.0


def test_a_port_that_is_taken_is_refused_only_if_it_was_asked_for():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(UsageError, match=f"--port {port}: cannot be opened: Address already"):
            free_port("127.0.0.1", port)
    assert 8080 <= free_port("127.0.0.1", None) < 8180
