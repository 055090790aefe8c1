import math
from dataclasses import replace

import numpy as np
import pytest

from nav.messages import Decision, EgoEstimate
from nav.route.corridor import depth
from nav.route.geodesy import Frame
from nav.route.waypoints import Waypoints
from scenarios.course import Course, Gate, Patience
from scenarios.verdicts import Judge
from scenarios.verdicts.corridor import segments
from scenarios.verdicts.shapes import Outline, bottom_m, distances_m, footprints
from scenarios.verdicts.tracking import line_offset_m
from twin.truth import Truth
from twin.world import Obstacle, World

ANCHOR = (34.9, -117.0)
TIRES = [(x, y) for x in (1.70, 0.59, -0.59) for y in (0.62, -0.62)]
TICK_NS = 20_000_000
OUTLINE = Outline()


class Flat:
    def height(self, x, y):
        return np.zeros(np.broadcast(x, y).shape)


def post(name, x, y):
    return Obstacle(name, "gate_post", "cylinder", (x, y, 0.5), (0.1, 0.1, 0.5), owner=name)


def box(name, x, y, kind="car", half=(1.0, 0.5, 0.5), z=0.5, yaw=0.0):
    quat = (math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2))
    return Obstacle(name, kind, "box", (x, y, z), half, quat, owner=name)


def rddf(waypoints, half_width_m):
    lat, lon = Frame(*ANCHOR).to_geodetic(np.array(waypoints, dtype=float))
    rows = [
        f"{k + 1},{a:.10f},{o:.10f},{half_width_m / 0.3048:.3f},{10 if k + 1 < len(lat) else 0}"
        for k, (a, o) in enumerate(zip(lat, lon, strict=True))
    ]
    return "\n".join(rows)


def course(waypoints=((0, 0), (60, 0), (100, 0)), obstacles=(), gates=(), tunnel=None, width=3.0):
    world = World(Flat(), tuple(obstacles), 0.7, ANCHOR, (0.0, 0.0, 0.0))
    return Course(
        "tiny",
        "a straight line",
        0,
        world,
        rddf(waypoints, width),
        "tiny.rddf",
        np.array(waypoints, dtype=float),
        np.full(len(waypoints), width),
        np.full(len(waypoints), 4.5),
        600.0,
        tuple(gates),
        tunnel,
    )


def gate(x, y=0.0, width=3.6):
    return Gate(np.array([x, y + width / 2]), np.array([x, y - width / 2]))


def truth(k, x, y, heading=0.0, speed=5.0, contacts=()):
    c, s = math.cos(heading), math.sin(heading)
    tires = [(x + c * u - s * v, y + s * u + c * v, 0.3175) for u, v in TIRES]
    position = np.array([x, y, 0.0])
    return Truth(k * TICK_NS, position, heading, 0.0, 0.0, speed, np.array(tires), contacts)


def decision(k, state="path_point_keeping"):
    numbers = (0, 0.0, 0.0, "", 0.0, 0.0, 0.0, 0.0, 0.0)
    return Decision(k * TICK_NS, state, "", "", *numbers)


def estimate(k, x, y):
    return EgoEstimate(k * TICK_NS, np.array([x, y]), 0.0, 5.0, 0.0, 0.0, 0.0, 0.1, 0.01)


def drive(judge, points, heading=0.0, speed=5.0, first=0):
    """Show the judge a sequence of positions, one a tick, until it is over."""
    for k, (x, y) in enumerate(points, first):
        judge.observe(truth(k, x, y, heading, speed), None, None)
        if judge.outcome:
            break
    return judge


def line(start, end, step=0.1):
    start, end = np.array(start, dtype=float), np.array(end, dtype=float)
    n = int(np.hypot(*(end - start)) / step) + 1
    return (start + (end - start) * t for t in np.linspace(0, 1, n))


def test_a_drive_to_the_last_waypoint_is_finished():
    judge = drive(Judge(course()), line((0, 0), (110, 0)))
    figures = judge.figures()
    assert judge.outcome == "finished"
    assert figures["waypoints_passed"] == figures["waypoints_total"] == 3
    assert figures["distance_m"] == pytest.approx(100.0 - 2.10, abs=0.11)
    assert figures["max_speed_mps"] == 5.0
    assert figures["min_clearance_m"] is None
    assert figures["cross_track_rms_m"] is None


def test_waypoints_count_where_the_line_that_halves_the_corner_is_crossed():
    judge = Judge(course(((0, 0), (50, 0), (50, 50)), width=9.0))
    drive(judge, line((0, 0), (48, 0)))
    assert judge.figures()["waypoints_passed"] == 1
    drive(judge, line((48, 0), (48, 5)), first=1000)
    assert judge.figures()["waypoints_passed"] == 2


def test_a_gate_is_passed_by_the_whole_outline():
    judge = Judge(course(gates=[gate(30)]))
    drive(judge, line((20, 0.5), (30.9, 0.5)))
    assert judge.figures()["gates_passed"] == 0
    drive(judge, line((30.9, 0.5), (31.1, 0.5)), first=500)
    assert judge.figures()["gates_passed"] == 1
    assert judge.figures()["gates_total"] == 1


def test_a_gate_passed_beside_the_opening_is_missed():
    judge = drive(Judge(course(gates=[gate(30, y=1.5), gate(60)])), line((20, 0), (70, 0)))
    assert judge.figures()["gates_passed"] == 1
    assert judge.figures()["gates_missed"] == [0]


def test_a_gate_half_entered_and_left_sideways_is_missed():
    judge = Judge(course(gates=[gate(30)], width=20.0))
    drive(judge, line((20, 0), (29, 0)))
    drive(judge, line((29, 0), (29, 6)), first=200)
    drive(judge, line((29, 6), (40, 6)), first=400)
    assert judge.figures()["gates_passed"] == 0


def test_a_gate_backwards_does_not_count_and_forwards_after_it_does():
    judge = Judge(course(gates=[gate(30)]))
    drive(judge, line((33, 0), (25, 0)), heading=math.pi)
    assert judge.figures()["gates_passed"] == 0
    drive(judge, line((25, 0), (33, 0)), first=200)
    assert judge.figures()["gates_passed"] == 1


def test_gates_count_in_order_only():
    judge = Judge(course(gates=[gate(60), gate(30)]))
    drive(judge, line((20, 0), (80, 0)))
    assert judge.figures()["gates_passed"] == 1
    judge = Judge(course(gates=[gate(30), gate(60)]))
    drive(judge, line((50, 0), (70, 0)))
    drive(judge, line((20, 0), (40, 0)), first=1000)
    assert judge.gates.passed == [1]
    assert judge.figures()["gates_missed"] == [0]


def test_a_gate_may_be_passed_in_any_direction_of_the_compass():
    turned = Gate(np.array([49.0 - 1.8, 30.0]), np.array([49.0 + 1.8, 30.0]))
    judge = Judge(course(((49, 0), (49, 60)), gates=[turned]))
    drive(judge, line((49, 20), (49, 40)), heading=math.pi / 2)
    assert judge.figures()["gates_passed"] == 1


def test_a_tire_outside_the_corridor_is_a_departure():
    judge = drive(Judge(course()), line((20, 0), (40, 2.30)))
    assert judge.outcome is None  # the outer tires stand 2.9 m from the line
    drive(judge, line((40, 2.30), (45, 2.5)), first=500)
    assert judge.outcome == "departure"
    assert judge.figures()["departures"] == 1


def test_departures_less_than_a_second_apart_are_one():
    judge = Judge(course(), departure_ends=False)
    for k, y in enumerate([3.0] * 10 + [0.0] * 40 + [3.0] * 10 + [0.0] * 60 + [3.0] * 10):
        judge.observe(truth(k, 20.0 + 0.1 * k, y), None, None)
    assert judge.figures()["departures"] == 2
    assert judge.outcome is None


def test_the_corridor_ends_two_segments_away():
    out = [(10.0 * k, 0.0) for k in range(6)]
    hairpin = [*out, (60.0, 10.0), *[(x, 20.0) for x, _ in out[::-1]]]
    judge = drive(Judge(course(hairpin)), [(5.0, 0.0), (5.0, 20.0)])
    assert judge.outcome == "departure"


def test_clearance_is_exact_and_by_family():
    obstacles = [box("car", 30, 3.0), post("g1", 50, 2.0), post("g2", 50, -1.8)]
    judge = Judge(course(obstacles=obstacles))
    drive(judge, line((0, 0), (20, 0)))
    first = judge.figures()
    assert first["min_clearance_m"] == pytest.approx(math.hypot(29.0 - 22.1, 2.5 - 0.762))
    drive(judge, line((20, 0), (80, 0)), first=500)
    last = judge.figures()
    assert last["min_clearance_m"] == pytest.approx(2.5 - 0.762)
    assert last["gate_clearance_m"] == pytest.approx(1.8 - 0.1 - 0.762)
    assert last["tunnel_clearance_m"] is None


def test_what_is_soft_or_hangs_overhead_is_no_obstacle():
    roof = box("roof", 40, 0, kind="tunnel", half=(10, 2, 0.05), z=3.5)
    obstacles = [box("strip", 30, 0, kind="rumble_strip"), roof]
    judge = Judge(course(obstacles=obstacles))
    drive(judge, line((0, 0), (60, 0)))
    assert judge.figures()["min_clearance_m"] is None
    assert judge.figures()["tunnel_clearance_m"] is None
    judge.observe(truth(700, 60, 0, contacts=("strip",)), None, None)
    assert judge.outcome is None


def test_the_first_contact_ends_the_drive():
    judge = Judge(course(obstacles=[box("car", 30, 0)]))
    judge.observe(truth(1, 20, 0, contacts=("ground",)), None, None)
    assert judge.outcome is None
    judge.observe(truth(2, 20, 0, contacts=("ground", "car")), None, None)
    assert judge.outcome == "contact"
    assert judge.figures()["contacts"] == 1
    assert judge.figures()["grounded"] == 1


def test_contacts_are_merged_within_a_second_an_object():
    judge = Judge(course(obstacles=[box("car", 30, 0), box("bale", 40, 0)]))
    for k in (1, 2, 40, 100):
        judge.observe(truth(k, 20, 0, contacts=("car",)), None, None)
    judge.observe(truth(101, 20, 0, contacts=("bale", "car")), None, None)
    assert judge.figures()["contacts"] == 3
    assert judge.figures()["contact_objects"] == ["car", "bale"]


def test_stuck_after_a_minute_within_a_metre():
    judge = Judge(replace(course(), patience=Patience(60.0)))
    drive(judge, ((20.0 + 0.4 * (k % 2), 0.0) for k in range(2999)))
    assert judge.outcome is None
    drive(judge, ((20.0, 0.0) for _ in range(5)), first=2999)
    assert judge.outcome == "stuck"
    slow = drive(Judge(course()), ((20.0 + 0.0005 * k, 0.0) for k in range(4000)))
    assert slow.outcome is None


def test_timeout_at_the_limit_of_the_course():
    judge = drive(Judge(course()), [(20.0, 0.0)], first=30_000)
    assert judge.outcome == "timeout"


def test_cross_track_is_measured_in_path_point_keeping_only():
    judge = Judge(course(obstacles=[box("car", 85, 2.5)]))
    for k in range(0, 500, 5):
        x, state = 0.1 * k, "obstacle_avoidance" if k < 250 else "path_point_keeping"
        judge.observe(
            truth(k, x, 0.4), estimate(k, x, 0.1 if k >= 250 else 2.0), decision(k, state)
        )
    figures = judge.figures()
    assert figures["cross_track_rms_m"] == pytest.approx(0.1, abs=1e-3)
    assert figures["true_cross_track_rms_m"] == pytest.approx(0.4, abs=1e-3)
    assert judge.true.deviation.count == 50
    judge.observe(truth(500, 50, 0.4, speed=0.9), estimate(500, 50, 0.1), decision(500))
    judge.observe(truth(505, 75, 0.4), estimate(505, 75, 0.1), decision(505))
    assert judge.true.deviation.count == 50  # too slow, then a car within 15 m


def test_cross_track_survives_a_gap_in_what_counts():
    judge = Judge(course())
    for k in range(0, 500, 5):
        state = "path_point_keeping" if k in (0, 495) else "tunnel_mode"
        judge.observe(truth(k, 0.1 * k, 0.0), estimate(k, 0.1 * k, 0.0), decision(k, state))
    assert judge.figures()["cross_track_rms_m"] == pytest.approx(0.0, abs=1e-3)


def test_states_are_counted_in_seconds():
    judge = Judge(course())
    judge.observe(truth(0, 0, 0), None, None)
    for k in range(1, 51):
        judge.observe(truth(k, 0, 0), None, decision(k, "tunnel_mode"))
    assert judge.figures()["states"] == {"starting": 0.02, "tunnel_mode": 1.0}


def test_the_offset_from_the_tunnel_counts_inside_only():
    bend = np.array([[30.0, 0.5], [40.0, 0.5], [50.0, 1.0]])
    judge = Judge(course(tunnel=bend))
    for k in range(0, 600, 5):
        judge.observe(truth(k, 0.1 * k, 0.0), estimate(k, 0.1 * k, 0.0), decision(k, "tunnel_mode"))
    assert judge.figures()["tunnel_offset_max_m"] == pytest.approx(1.0, abs=0.05)
    assert 0.5 < judge.figures()["tunnel_offset_rms_m"] < 0.8
    assert line_offset_m(bend, np.array([29.0, 0.0])) is None
    assert line_offset_m(bend, np.array([51.0, 0.0])) is None


def test_distances_agree_with_a_dense_sampling():
    rng = np.random.default_rng(0)
    pose = (0.4, -0.3, 0.7)
    for k in range(40):
        yaw, half = rng.uniform(-3, 3), rng.uniform(0.2, 3.0, 3)
        shape = box("b", *rng.uniform(-7, 7, 2), half=tuple(half), yaw=yaw)
        grid = np.stack(np.meshgrid(*[np.linspace(-1, 1, 200)] * 2), -1).reshape(-1, 2) * half[:2]
        c, s = math.cos(yaw), math.sin(yaw)
        points = grid @ np.array([[c, s], [-s, c]]) + shape.center_m[:2]
        found = distances_m(OUTLINE, pose, footprints([shape]))[0]
        assert found == pytest.approx(to_outline(points, pose), abs=0.03), k


def to_outline(points, pose):
    c, s = math.cos(pose[2]), math.sin(pose[2])
    local = (points - pose[:2]) @ np.array([[c, -s], [s, c]])
    x = np.maximum(np.maximum(local[:, 0] - 2.10, -0.95 - local[:, 0]), 0.0)
    y = np.maximum(np.abs(local[:, 1]) - 0.762, 0.0)
    return np.hypot(x, y).min()


def test_overlap_without_a_corner_inside_is_no_distance():
    across = box("b", 0.5, 0.0, half=(0.2, 5.0, 0.5))
    assert distances_m(OUTLINE, (0.0, 0.0, 0.0), footprints([across]))[0] == 0.0


def test_the_shadow_of_a_tilted_box():
    half, angle = (1.0, 0.5, 0.2), 0.5
    tilted = Obstacle(
        "t", "slope", "box", (4.0, 0.0, 1.0), half, (math.cos(angle / 2), 0, math.sin(angle / 2), 0)
    )
    reach = math.cos(angle) * 1.0 + math.sin(angle) * 0.2
    found = distances_m(OUTLINE, (0.0, 0.0, 0.0), footprints([tilted]))[0]
    assert found == pytest.approx(4.0 - reach - 2.10)
    assert bottom_m(tilted) == pytest.approx(1.0 - math.sin(angle) - math.cos(angle) * 0.2)


def test_what_a_segment_holds_lies_in_the_corridor():
    """The quick look before the thorough one never says more than that would."""
    rng = np.random.default_rng(0)
    corners = np.array([(0.0, 0.0), (30.0, 5.0), (50.0, -20.0), (80.0, -20.0)])
    waypoints = Waypoints(corners, np.array([3.0, 5.0, 2.0, 2.0]), np.full(4, 5.0))
    point_m = rng.uniform((-10.0, -30.0), (90.0, 15.0), (3000, 2))
    for k, segment in enumerate(segments(waypoints)):
        held = np.array([segment.holds([point]) for point in point_m.tolist()])
        deep = depth(point_m, waypoints, k, k) >= 0.0
        along = (point_m - corners[k]) @ (segment.cos, segment.sin)
        beside = (along >= 0.0) & (along <= segment.length_m)
        np.testing.assert_array_equal(held, deep & beside)
        assert held.any()


# ---------------------------------------------------------------- falls


def test_a_vehicle_on_its_side_has_fallen():
    judge = Judge(course())
    for k, roll in enumerate((0.0, 0.5, 0.8)):
        judge.observe(replace(truth(k, 0.1 * k, 0.0), roll_rad=roll), None, None)
        assert judge.outcome == ("fell" if roll > 0.785 else None)
    assert judge.figures()["max_tilt_rad"] == pytest.approx(0.8)


@pytest.mark.parametrize(("sink_mps", "outcome"), [(0.6, None), (1.0, "fell")])
def test_who_sinks_faster_than_courses_slope_has_fallen(sink_mps, outcome):
    judge = Judge(course())
    for k in range(100):
        low = np.array([0.1 * k, 0.0, -sink_mps * 0.02 * k])
        judge.observe(replace(truth(k, 0.1 * k, 0.0), position_m=low), None, None)
    assert judge.outcome == outcome
