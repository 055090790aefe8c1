"""What people see: well-known schemas, at most 10 Hz, derived from the tape alone."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.reader import make_reader

from nav.messages import (
    Decision,
    EgoEstimate,
    FollowPath,
    GpsFix,
    GpsQuality,
    ImuSample,
    LidarScan,
    ObstacleCells,
)
from tape.reader import read
from tape.record import record
from tape.view import View
from tape.writer import TapeWriter


class Mount(NamedTuple):
    """Where a scanner sits, as the vehicle's parameters have it."""

    position_m: tuple[float, float, float] = (1.30, 0.0, 1.90)
    yaw_rad: float = 0.0
    pitch_rad: float = math.pi / 2
    roll_rad: float = 0.0


def ego(time_ns, x_m=3.0, heading_rad=0.0):
    return EgoEstimate(time_ns, [x_m, 4.0], heading_rad, 2.0, 0.0, 0.0, 0.0, 0.1, 0.01)


def decision(time_ns, state="path_point_keeping", reason="start"):
    return Decision(time_ns, state, reason, "", 3, 0.5, math.pi / 2, "", 20.0, 15.0, 9.0, 4.0, 0.0)


def scan(time_ns):
    return LidarScan(time_ns, "lidar_roof", np.linspace(100, 4600, 361).astype(int) * 0.01)


def second():
    """One simulated second of everything that is drawn."""
    for tick in range(50):
        now = tick * 20_000_000
        yield scan(now)
        yield GpsFix(now, GpsQuality.CONVERGED, 9, 34.0, -117.0, 300.0, 0.2, [0.0] * 3)
        yield ego(now)
        yield decision(now)
        yield FollowPath(now, np.arange(20.0).reshape(10, 2), 4.0)
    yield ObstacleCells(now, [[5.0, 6.0], [7.0, 8.0]], [0.5, 1.0])


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """Decoded messages by topic; each decodes by the schema that its file carries."""
    path = tmp_path_factory.mktemp("view") / "run.mcap"
    with TapeWriter(path, view=View({"lidar_roof": Mount()})) as tape:
        for each in second():
            tape.write(record(each.time_ns, each))
    found = {}
    with open(path, "rb") as file:
        for schema, channel, message in make_reader(file).iter_messages():
            if channel.topic.startswith("/view/"):
                decoded = decode(schema, message.data)
                found.setdefault(channel.topic, []).append((schema.name, decoded))
    return found


def decode(schema, data):
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(schema.data).file:
        pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(schema.name)).FromString(data)


def test_every_topic_has_its_well_known_schema_and_rate(drawn):
    assert {t: (found[0][0], len(found)) for t, found in drawn.items()} == {
        "/view/lidar_roof": ("foxglove.LaserScan", 5),
        "/view/gps": ("foxglove.LocationFix", 5),
        "/view/frames": ("foxglove.FrameTransforms", 10),
        "/view/mountings": ("foxglove.FrameTransforms", 1),
        "/view/vehicle": ("foxglove.SceneUpdate", 1),
        "/view/path": ("foxglove.PosesInFrame", 5),
        "/view/decision": ("foxglove.SceneUpdate", 5),
        "/view/log": ("foxglove.Log", 1),
        "/view/obstacles": ("foxglove.PointCloud", 1),
    }


def test_the_scan_keeps_its_ranges_and_hides_what_did_not_return(drawn):
    _, shown = drawn["/view/lidar_roof"][0]
    assert shown.frame_id == "lidar_roof"
    assert (shown.start_angle, shown.end_angle) == (-math.pi / 2, math.pi / 2)
    np.testing.assert_allclose(shown.ranges, scan(0).range_m, atol=1 / 128)


def test_no_return_is_infinite():
    silent = LidarScan(0, "lidar_roof", [8192 * 0.01, 8191 * 0.01])
    [(_, shown)] = View({"lidar_roof": Mount()}).update(record(0, silent))
    decoded = decode(shown.get_schema(), shown.encode())
    assert decoded.ranges[0] == math.inf
    assert decoded.ranges[1] == pytest.approx(81.91, abs=0.01)


def test_frames_chain_from_route_to_scanner(drawn):
    _, vehicle = drawn["/view/frames"][0]
    _, mountings = drawn["/view/mountings"][0]
    [first], [second] = vehicle.transforms, mountings.transforms
    assert (first.parent_frame_id, first.child_frame_id) == ("route", "vehicle")
    assert (first.translation.x, first.translation.y) == (3.0, 4.0)
    assert (second.parent_frame_id, second.child_frame_id) == ("vehicle", "lidar_roof")
    assert second.translation.z == 1.90
    assert rotated(second.rotation, [1.0, 0.0, 0.0]) == pytest.approx([0.0, 0.0, -1.0])


def rotated(q, vector):
    """q v q*, by the textbook's cross products."""
    axis = np.array([q.x, q.y, q.z])
    twice = 2 * np.cross(axis, vector)
    return list(vector + q.w * twice + np.cross(axis, twice))


@pytest.mark.parametrize(
    ("angles", "vector", "expected"),
    [
        ((math.pi / 2, 0.0, 0.0), [1, 0, 0], [0, 1, 0]),  # heading to the left: north
        ((0.0, 0.1, 0.0), [1, 0, 0], [math.cos(0.1), 0, -math.sin(0.1)]),  # nose down
        ((0.0, 0.0, 0.1), [0, 1, 0], [0, math.cos(0.1), math.sin(0.1)]),  # left side up
        ((math.pi / 2, 0.1, 0.0), [1, 0, 0], [0, math.cos(0.1), -math.sin(0.1)]),
    ],
)
def test_attitude_has_the_signs_of_the_contract(angles, vector, expected):
    heading_rad, pitch_rad, roll_rad = angles
    estimate = EgoEstimate(0, [0, 0], heading_rad, 0, 0, roll_rad, pitch_rad, 0, 0)
    shown = dict(View().update(record(0, estimate)))["/view/frames"]
    rotation = decode(shown.get_schema(), shown.encode()).transforms[0].rotation
    assert rotated(rotation, vector) == pytest.approx(expected)


def test_pathpoints_look_at_the_next(drawn):
    _, shown = drawn["/view/path"][0]
    assert shown.frame_id == "route"
    assert [(p.position.x, p.position.y) for p in shown.poses][:2] == [(0.0, 1.0), (2.0, 3.0)]
    for pose in shown.poses:
        assert 2 * math.atan2(pose.orientation.z, pose.orientation.w) == pytest.approx(math.pi / 4)


def test_obstacles_carry_place_and_confidence(drawn):
    _, shown = drawn["/view/obstacles"][0]
    assert [f.name for f in shown.fields] == ["x", "y", "confidence"]
    points = np.frombuffer(shown.data, np.float32).reshape(-1, shown.point_stride // 4)
    assert points.tolist() == [[5.0, 6.0, 0.5], [7.0, 8.0, 1.0]]


def test_the_decision_points_where_it_was_decided(drawn):
    _, shown = drawn["/view/decision"][0]
    goal, decided = shown.entities[0].arrows
    assert rotated(goal.pose.orientation, [1, 0, 0])[1] == pytest.approx(math.sin(0.5))
    assert rotated(decided.pose.orientation, [1, 0, 0]) == pytest.approx([0, 1, 0], abs=1e-9)
    assert (decided.pose.position.x, decided.shaft_length) == (3.0, 15.0)
    assert "path_point_keeping" in shown.entities[0].texts[0].text


def test_the_vehicle_is_a_box_of_its_size(drawn):
    _, shown = drawn["/view/vehicle"][0]
    [box] = shown.entities[0].cubes
    assert (box.size.x, box.size.y, box.size.z) == pytest.approx((3.05, 1.524, 1.98))
    assert (box.pose.position.x, box.pose.position.z) == pytest.approx((0.575, 0.99))


def test_the_fix_carries_the_receivers_error(drawn):
    _, shown = drawn["/view/gps"][0]
    assert (shown.latitude, shown.longitude) == (34.0, -117.0)
    assert shown.position_covariance[0] == pytest.approx(0.04)


def test_a_lost_fix_is_not_drawn():
    lost = GpsFix(0, GpsQuality.NONE, 0, 34.0, -117.0, 300.0, 0.2, [0.0] * 3)
    assert View().update(record(0, lost)) == []


def test_state_changes_are_logged_with_their_reason():
    view, lines = View(), []
    for k, (state, reason) in enumerate([("a", "x"), ("a", "x"), ("b", "y"), ("b", "z")]):
        made = record(k, decision(k, state, reason))
        lines += [decode(m.get_schema(), m.encode()).message for _, m in view.update(made)]
    assert lines == ["a: x", "b: y", "b: z"]


def test_what_is_not_drawn_adds_nothing():
    view = View()
    assert view.update(record(0, ImuSample(0, [0.0] * 3, [0.0] * 3, 0.0, 0.0))) == []
    assert view.update(record(0, scan(0))) == []  # nobody said where it sits


def test_the_view_can_be_drawn_again_from_the_tape(tmp_path):
    records = [record(m.time_ns, m) for m in second()]
    with TapeWriter(tmp_path / "run.mcap", mode="inputs") as tape:
        for each in records:
            tape.write(each)
    assert bytes_of(read(tmp_path / "run.mcap")) == bytes_of(records)


def bytes_of(records):
    view = View({"lidar_roof": Mount()})
    return [(topic, m.encode()) for each in records for topic, m in view.update(each)]
