"""`ion reconstruct`: things from returns, faults from messages, and the file that says both."""

import json
from itertools import pairwise
from math import inf, radians
from pathlib import Path

import numpy as np
import pytest
from test_cli import ion, refused
from test_route_course import straight_route
from test_scenery import TARGETS

from ion.courses import scenario_source
from ion.job import Job
from ion.reconstruct.command import reconstruct
from ion.reconstruct.evidence import Evidence
from ion.reconstruct.failures import failures
from ion.reconstruct.obstacles import things
from ion.reconstruct.options import Options
from ion.reconstruct.rebuilt import Rebuilt, rebuilt
from ion.reconstruct.rectangles import pieces, smallest
from ion.reconstruct.scenario_text import route_text, scenario_text
from ion.reconstruct.standing import standing
from ion.reconstruct.stream import Listener, Stream
from ion.reconstruct.stretches import Stretch, Stretches
from ion.reconstruct.tally import Tally, cell_of, counted, merged, row_column
from nav.messages import CompassHeading, GpsFix, GpsQuality, RadarTracks
from scenarios.planned import Thing
from scenarios.scenario_file import ScenarioFileError, read_scenario
from twin.faults import Fault, parse
from twin.simulator import Simulator

CELL_M = 0.2
END_S = 60.0
ROUTE_LINES = route_text("r.rddf", {})
PERIOD_S = 0.1
STRAIGHT = np.stack([np.arange(0.0, 60.0, 0.5), np.zeros(120)], axis=1)
"""A way along the x axis."""


def returns(*faces, height_m=1.0, many=50):
    """Places (3, n) of beams that ended on straight faces, each from one point to another."""
    share = np.linspace(0.0, 1.0, 400)
    flat = np.concatenate([np.outer(1.0 - share, a) + np.outer(share, b) for a, b in faces])
    return np.repeat(np.column_stack([flat, np.full(len(flat), height_m)]), many, axis=0).T


def found(*faces, way_m=STRAIGHT, **more):
    tally = counted(returns(*faces, **more), CELL_M)
    return things(tally, tally.cell, way_m, CELL_M)


# ---------------------------------------------------------------- cells


def test_cells_have_numbers_on_all_sides_of_the_first_waypoint():
    row, column = np.array([-3, 0, 5, -70_000]), np.array([-1, 7, -200_000, 3])
    np.testing.assert_array_equal(row_column(cell_of(row, column)), (row, column))


def test_tallies_add_up():
    place = returns(((1.0, 1.0), (3.0, -1.0)))
    whole = counted(place, CELL_M)
    parts = merged([counted(place[:, ::2], CELL_M), counted(place[:, 1::2], CELL_M)])
    np.testing.assert_array_equal(whole.cell, parts.cell)
    np.testing.assert_allclose(whole.place_m, parts.place_m)
    assert whole.returns.sum() == place.shape[1]


def test_strays_before_a_face_are_none_its_top_is_and_a_forgotten_face_too():
    returns_m = np.array([20.0, 1000.0, 21.0, 2.0, 900.0, 500.0])
    cell = cell_of(np.array([0, 1, 2, 3, 4, 9]), np.zeros(6, np.int64))
    tally = Tally(cell, returns_m, np.zeros((6, 2)), np.ones(6))
    found = standing(tally, cell[:4], 0.2 * np.arange(6.0))
    np.testing.assert_array_equal(found.returns, [1000.0, 21.0, 900.0])


# ---------------------------------------------------------------- rectangles


def test_a_box_of_which_two_sides_were_seen_is_a_box():
    (box,) = found(((10.0, 2.0), (10.0, 3.8)), ((10.0, 2.0), (14.6, 2.0)))
    assert box.at_m == pytest.approx((12.3, 2.9), abs=0.1)
    assert box.half_m == pytest.approx((2.3, 0.9), abs=0.15)
    assert box.height_m == 1.0


def test_a_dead_end_is_three_walls():
    walls = found(((10, 3), (40, 3)), ((10, -3), (40, -3)), ((40, -3), (40, 3)))
    assert len(walls) == 3
    assert sorted(round(wall.half_m[0]) for wall in walls) == [3, 15, 15]
    assert all(wall.half_m[1] <= 0.15 for wall in walls)


def test_a_bent_wall_is_a_few_straight_ones():
    bend = np.radians(np.linspace(0.0, 90.0, 40))
    line = np.stack([10.0 + 20.0 * np.sin(bend), 25.0 - 20.0 * np.cos(bend)], axis=1)
    walls = found(*pairwise(line), way_m=line - 3.0, many=1)
    assert 3 <= len(walls) <= 12
    assert sum(2.0 * wall.half_m[0] for wall in walls) == pytest.approx(31.4, abs=3.0)


def test_a_turned_box_keeps_its_heading():
    c, s = np.cos(radians(30.0)), np.sin(radians(30.0))
    corner = [(5, 5), (5 + 4 * c, 5 + 4 * s), (5 + 4 * c - s, 5 + 4 * s + c), (5 - s, 5 + c)]
    (box,) = found(*zip(corner, corner[1:] + corner[:1], strict=True))
    assert box.yaw_deg == pytest.approx(30.0, abs=2.0)


def test_a_face_lies_where_it_was_seen_and_the_thing_behind_it():
    (left,), (right,) = found(((5, 2.05), (9, 2.05))), found(((5, -2.05), (9, -2.05)))
    for wall, side in ((left, 1.0), (right, -1.0)):
        assert side * wall.at_m[1] - wall.half_m[1] == pytest.approx(2.05, abs=0.02)


def test_what_was_driven_through_is_brush():
    assert found(((20.0, -2.0), (20.0, 2.0)))[0].kind == "brush"
    assert found(((20.0, 0.8), (20.0, 2.0)))[0].kind == "seen"


def test_what_is_far_or_hardly_seen_is_left_out():
    assert found(((10, 15), (12, 15))) == []
    tally = counted(np.array([[5.0, 5.0], [1.0, 1.0], [0.5, 0.5]]), CELL_M)
    assert things(tally, tally.cell, STRAIGHT, CELL_M) == []
    assert found(((5.02, 2.02), (5.06, 2.02)))[0].shape == "cylinder"


def test_pieces_hold_every_point_once():
    point = np.random.default_rng(0).uniform(0.0, 30.0, (60, 2))
    parts = pieces(point, CELL_M)
    assert sorted(np.concatenate(parts).tolist()) == list(range(60))
    assert smallest(point[:1]).half_length == 0.0


# ---------------------------------------------------------------- faults


def stream(gaps=(), frozen=(), late=()):
    """A device at 10 Hz for a minute; stretches are of seconds."""
    at_s = np.arange(PERIOD_S, END_S, PERIOD_S)
    at_s = at_s[~_within(at_s, gaps)]
    delay_s = 0.02 + 1.5 * _within(at_s, late)
    heard = at_s + delay_s <= END_S
    repeats = _within(at_s, frozen)
    return Stream(at_s[heard], (at_s + delay_s)[heard], repeats[heard])


def _within(at_s, stretches):
    inside = np.zeros(len(at_s), bool)
    for begin, end in stretches:
        inside |= (at_s > begin - 1e-9) & (at_s < end - 1e-9)
    return inside


def only(heard, resets=()):
    (fault,) = failures("sonar", heard, resets, END_S)
    assert parse(str(fault), ("sonar",)) == fault
    return fault


def test_a_sound_device_has_no_fault():
    assert failures("sonar", stream(), (), END_S) == []


@pytest.mark.parametrize("kind", ["silent", "frozen", "late"])
def test_a_fault_has_its_times(kind):
    name = {"silent": "gaps"}.get(kind, kind)
    fault = only(stream(**{name: [(20.0, 30.0)]}))
    assert fault.kind == kind
    assert (fault.begins, fault.ends) == pytest.approx((20.0, 30.0), abs=0.06)
    assert fault.size == (1.5 if kind == "late" else None)
    lasting = only(stream(**{name: [(20.0, inf)]}))
    assert (lasting.kind, lasting.ends) == (kind, inf)


def test_a_reset_that_helped_is_a_recovery():
    fault = only(stream(gaps=[(20.0, 50.0)]), resets=[21.0, 41.0])
    assert fault.ends == inf
    assert fault.recovers_s == pytest.approx(29.0, abs=0.06)


def test_silences_that_come_and_go_are_one_fault():
    gaps = [(11.0, 12.0), (14.0, 16.0), (18.0, 20.0), (22.0, 24.0), (26.0, 26.7)]
    fault = only(stream(gaps=gaps))
    assert (fault.kind, fault.size) == ("flapping", pytest.approx(4.0, abs=0.1))
    assert (fault.begins, fault.ends) == pytest.approx((11.0, 26.7), abs=0.06)
    apart = failures("sonar", stream(gaps=[(10, 12), (20, 21), (40, 45)]), (), END_S)
    assert [fault.kind for fault in apart] == ["silent"] * 3


def test_what_never_spoke_is_silent_from_the_start():
    none = Stream(np.zeros(0), np.zeros(0), np.zeros(0, bool))
    assert failures("radar", none, (), END_S) == [Fault("radar", "silent", 0.0)]


def heard(messages):
    listener = Listener()
    for message in messages:
        listener.hear(message.time_ns + 10**7, message)
    return listener.stream(0)


def test_only_what_says_something_repeats_itself():
    empty = [RadarTracks(k * 10**8, np.zeros(0), np.zeros(0), np.zeros(0)) for k in range(9)]
    assert not heard(empty).repeats.any()
    same = [CompassHeading(k * 10**8, 0.5) for k in range(9)]
    assert heard(same).repeats.tolist() == [False, *[True] * 8]
    lost = [GpsFix(k, GpsQuality.NONE, 2, 34.0, -117.0, 0.0, 9.0, np.zeros(3)) for k in range(9)]
    assert not heard(lost).repeats.any()


def test_stretches_go_over_small_gaps():
    held = Stretches()
    for time_s in (1.0, 1.5, 2.4, 9.0):
        held.holds(time_s, "gps", "3 satellites")
    assert [(s.from_s, s.to_s) for s in held.all()] == [(1.0, 2.4), (9.0, 9.0)]


# ---------------------------------------------------------------- the file

THINGS = [
    Thing("seen", (12.34, -5.6), (2.0, 0.1), 1.2, yaw_deg=33.0, shift_m=0.0),
    Thing("seen", (20.0, 1.0), (0.1, 0.1), 0.8, shape="cylinder", shift_m=0.0),
]
FAULTS = [Fault("radar", "silent", 12.5, recovers_s=90.0), Fault("sonar", "late", 3.0, 9.0, size=2)]


def told(unfixed=(), doubted=()):
    tally = counted(np.zeros((3, 0)), CELL_M)
    return Evidence(
        END_S,
        False,
        np.array([0.0]),
        STRAIGHT[:1],
        tally,
        tally.cell,
        CELL_M,
        {},
        {},
        [*unfixed],
        [*doubted],
        (),
    )


def test_a_file_says_what_was_found(tmp_path):
    (tmp_path / "r.rddf").write_text(straight_route(3))
    text = scenario_text(Rebuilt(THINGS, FAULTS, told()), 'A "tape".', ROUTE_LINES, 99.0)
    (tmp_path / "s.toml").write_text(text)
    scenario = read_scenario(tmp_path / "s.toml")
    assert scenario.title == 'A "tape".'
    assert scenario.things == tuple(THINGS)
    assert scenario.faults == tuple(map(str, FAULTS))
    assert (scenario.roadside, scenario.bumps, scenario.time_limit_s) == (False, 0.0, 99.0)
    assert scenario.verdicts == {"outcome": "finished", "contacts": 0}


def test_what_is_no_fault_is_a_comment(tmp_path):
    found = Rebuilt(
        [],
        FAULTS,
        told([Stretch("gps", 1.0, 9.0, "2 satellites")], [Stretch("imu", 5.0, 8.0, "x")]),
    )
    lines = scenario_text(found, "A tape.", ROUTE_LINES, 99.0).splitlines()
    assert any(line.startswith("# gps spoke, but had no fix from 1.0 s") for line in lines)
    assert any(line.startswith("# imu was not believed from 5.0 s to 8.0 s") for line in lines)
    explained = Rebuilt([], FAULTS, told(doubted=[Stretch("radar", 13.0, 14.0, "x")]))
    assert "not believed" not in scenario_text(explained, "A tape.", ROUTE_LINES, 99.0)


def test_an_empty_world_is_one():
    found = rebuilt(told())
    assert (found.things, found.faults) == ([], [])


ROUTE = 'title = "Mine."\nroute = "r.rddf"\nroadside = false\nbumps = 0.0\n'
PLACED = 'things = [{ kind = "tires", at_m = [40.0, 1.5], half_m = [0.3, 0.3], shift_m = 0.0 }]\n'


def test_a_file_with_a_route_places_things_and_nothing_else_stands_there(tmp_path):
    (tmp_path / "r.rddf").write_text(straight_route(9))
    path = tmp_path / "mine.toml"
    path.write_text(ROUTE + PLACED)
    world = read_scenario(path).drawn_course(3).world
    (tires,) = world.everything()
    assert tires.center_m[:2] == (40.0, 1.5)
    assert world.around(0.0, 0.0) == (tires,)
    assert not world.terrain.height(np.arange(99.0), np.arange(99.0)).any()


def test_things_stay_where_they_are_when_the_drive_begins_farther_on(tmp_path):
    (tmp_path / "r.rddf").write_text(straight_route(9))
    path = tmp_path / "mine.toml"
    path.write_text(ROUTE + PLACED)
    whole = read_scenario(path).drawn_course(0)
    path.write_text(ROUTE + "from = 3\n" + PLACED)
    later = read_scenario(path).drawn_course(0)
    away = whole.waypoint_m[2] - later.waypoint_m[0]
    (tires,), (same,) = whole.world.everything(), later.world.everything()
    np.testing.assert_allclose(np.subtract(tires.center_m, same.center_m)[:2], away, atol=0.01)


def test_things_stand_beside_what_the_seed_draws(tmp_path):
    (tmp_path / "r.rddf").write_text(straight_route(9))
    path = tmp_path / "mine.toml"
    path.write_text('title = "Mine."\nroute = "r.rddf"\n')
    drawn = read_scenario(path).drawn_course(0).world.everything()
    path.write_text('title = "Mine."\nroute = "r.rddf"\n' + PLACED)
    both = read_scenario(path).drawn_course(0).world.everything()
    assert both[: len(drawn)] == drawn
    assert [o.kind for o in both[len(drawn) :]] == ["tires"]


def test_there_is_room_for_as_much_as_a_file_puts_in_one_place(tmp_path):
    (tmp_path / "r.rddf").write_text(straight_route(9))
    post = '{{ kind = "post", at_m = [{:g}, 4.0], half_m = [0.1, 0.1], shape = "{}" }},\n'
    posts = [post.format(k / 5, ("box", "cylinder")[k % 2]) for k in range(400)]
    path = tmp_path / "mine.toml"
    path.write_text(ROUTE + "things = [\n" + "".join(posts) + "]\n")
    world = read_scenario(path).drawn_course(0).world
    assert 80 <= world.room["box"] < 170  # 80 of each in 32 m; no more than twice that is kept
    assert world.room["box"] == pytest.approx(world.room["cylinder"], abs=1)
    Simulator(world, 0).advance(TARGETS)


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ('course = "nqe"\nroadside = false\n', "with a route only"),
        ('course = "nqe"\n' + PLACED, "with a route only"),
        ('route = "r.rddf"\nbumps = -1.0\n', "0 or more"),
        ('route = "r.rddf"\nthings = [{ kind = "x", at = [1, 2] }]\n', "at"),
        ('route = "r.rddf"\n' + PLACED.replace("[0.3, 0.3]", "[0.3, 0]"), "half_m above 0"),
        ('route = "r.rddf"\n' + PLACED.replace("shift_m = 0.0", "height_m = -1.0"), "above bottom"),
    ],
)
def test_a_wrong_world_is_refused(lines, expected, tmp_path):
    (tmp_path / "r.rddf").write_text(straight_route(3))
    path = tmp_path / "mine.toml"
    path.write_text('title = "Mine."\n' + lines)
    with pytest.raises(ScenarioFileError, match=expected):
        read_scenario(path)


# ---------------------------------------------------------------- the command


def test_wrong_input_is_one_line(monkeypatch, capsys, tmp_path):
    assert "cannot be read" in refused(monkeypatch, capsys, "reconstruct", tmp_path / "no.mcap")
    words = tmp_path / "words.mcap"
    words.write_text("no tape at all")
    assert "not a tape" in refused(monkeypatch, capsys, "reconstruct", words)
    said = refused(monkeypatch, capsys, "reconstruct", words, "--out", tmp_path / "x.json")
    assert "ends in .toml" in said
    below = words / "x.toml"
    assert "cannot be written" in refused(monkeypatch, capsys, "reconstruct", words, "--out", below)


SHORT = """\
title = "A stack of bales, and a radar that falls silent."
course = "trial"
time_limit_s = {limit}
waypoints = [[0, 0, 4.0, 10], [30, 0, 4.0, 10], [60, 0, 4.0, 0]]
things = [{{ kind = "hay_bale", at_m = [40, 1.5], half_m = [0.25, 1.0], height_m = 0.84, shift_m = 0.0 }}]
faults = ["radar silent 2s"]
"""  # noqa: E501


def drive(folder, limit):
    path = folder / "short.toml"
    path.write_text(SHORT.format(limit=limit))
    return Job(scenario_source(str(path)), folder, "inputs").drive(0)


def test_a_tape_becomes_a_scenario(monkeypatch, capsys, tmp_path):
    log = drive(tmp_path, 3.0)["log"]
    out = tmp_path / "again.toml"
    code, said, _ = ion(monkeypatch, capsys, "reconstruct", log, "--out", out, "--json")
    assert code == 0
    assert json.loads(said)["faults"] == list(read_scenario(out).faults)
    (fault,) = read_scenario(out).faults
    assert parse(fault, ["radar"]).begins == pytest.approx(2.0, abs=0.05)
    assert out.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
    assert "timeout after 3 s" in read_scenario(out).title
    edited = out.read_text()
    assert "there already" in refused(monkeypatch, capsys, "reconstruct", log, "--out", out)
    assert out.read_text() == edited


def test_a_part_of_a_tape_becomes_a_part_of_a_route(monkeypatch, capsys, tmp_path):
    log = drive(tmp_path, 12.0)["log"]
    said = ion(monkeypatch, capsys, "reconstruct", log, "--from", "2", "--json")[1]
    later = read_scenario(Path(json.loads(said)["scenario"]))
    assert (later.first, later.last, later.faults) == (2, None, ("radar silent 0s",))
    assert later.title.endswith("from waypoint 2: timeout after 1 s.")
    assert later.things[0].at_m == pytest.approx((40.0, 1.5), abs=0.2)
    said = ion(monkeypatch, capsys, "reconstruct", log, "--to", "2", "--json")[1]
    before = read_scenario(Path(json.loads(said)["scenario"]))
    assert (before.first, before.last) == (None, 2)
    assert before.title.endswith("to waypoint 2: arrived after 11 s.")
    for stretch in (("--from", 3), ("--from", 2, "--to", 9)):
        assert "no stretch" in refused(monkeypatch, capsys, "reconstruct", log, *stretch)


@pytest.mark.slow
def test_a_reconstruction_is_driven(tmp_path):
    log = drive(tmp_path, 90.0)["log"]
    out = tmp_path / "again.toml"
    assert reconstruct(Options(Path(log), out, json=True)) == 0
    (bale,) = read_scenario(out).things
    assert bale.at_m == pytest.approx((40.0, 1.5), abs=0.2)
    again = Job(scenario_source(str(out)), tmp_path, "off").drive(0)
    assert all(verdict["passed"] for verdict in again["verdicts"])
