"""The random field: its numbers, its feasibility, and one drive that hears no truth."""

import json
import pickle
import sys

import numpy as np
import pytest

from ion.__main__ import main
from ion.drive.options import Options, job_of
from ion.errors import UsageError
from nav.messages import LidarScan
from scenarios.episode import Episode
from scenarios.random_field import build
from scenarios.random_field.draw import draw
from scenarios.random_field.feasibility import Task, feasible
from scenarios.random_field.field import CLEAR_START_M, DISC_M, scattered
from scenarios.random_field.shapes import STEP_M, wall

R = 6.0
KINDS = ("circles", "traps", "forks")


# ---------------------------------------------------------------------- the field's numbers


@pytest.mark.parametrize("density", [80, 160, 240])
def test_a_field_has_the_numbers_of_the_task(density):
    for seed in range(5):
        course = build(seed, density=density)
        circles = draw(seed, "circles", density).circles
        assert circles.shape == (density, 3)
        assert np.abs(circles[:, :2]).max() <= 100.0
        assert 0.5 <= circles[:, 2].min() <= circles[:, 2].max() <= 4.0
        assert len(course.world.obstacles) == density
        way = course.waypoint_m
        assert np.hypot(*(way[-1] - way[0])) == pytest.approx(180.0, abs=1e-3)
        assert len(way) > 2
        assert course.speed_mps == pytest.approx(8.0, abs=1e-4)
        assert (course.goal_m, course.time_limit_s) == (4.0, 200.0)
        assert course.half_width_m.min() > 200.0


def test_radii_and_places_are_spread_evenly():
    circles = np.vstack([draw(seed, "circles", 240).circles for seed in range(20)])
    assert circles[:, 2].mean() == pytest.approx(2.25, abs=0.1)
    assert circles[:, :2].std(axis=0) == pytest.approx(200.0 / np.sqrt(12.0), rel=0.05)


@pytest.mark.parametrize("kind", KINDS)
def test_start_and_goal_are_free(kind):
    for seed in range(30):
        field = draw(seed, kind, 240)
        for point, free in ((field.way_m[0], CLEAR_START_M), (field.way_m[-1], 4.0 + DISC_M)):
            gap = np.hypot(*(field.circles[:, :2] - point).T) - field.circles[:, 2]
            assert gap.min() > free


@pytest.mark.parametrize("kind", KINDS)
def test_a_seed_is_a_field(kind):
    one, same, other = (build(seed, kind) for seed in (7, 7, 8))
    assert one.world.obstacles == same.world.obstacles
    assert one.route_text == same.route_text
    assert one.world.start == same.world.start
    assert one.world.obstacles != other.world.obstacles


def test_defaults_are_told():
    assert build(0).facts == {"field": "circles", "density": 80, "feasible": True}
    assert build(0, "forks").facts["density"] == 40


@pytest.mark.parametrize("kind", ["traps", "forks"])
def test_the_straight_way_through_traps_and_forks_is_closed(kind):
    for seed in range(20):
        field = draw(seed, kind, 0)
        s = np.linspace(0.0, 1.0, 4000)[:, None]
        line = np.interp(s * (len(field.way_m) - 1), np.arange(len(field.way_m)), field.way_m[:, 0])
        north = np.interp(
            s * (len(field.way_m) - 1), np.arange(len(field.way_m)), field.way_m[:, 1]
        )
        gap = np.hypot(line - field.circles[:, 0], north - field.circles[:, 1])
        assert (gap - field.circles[:, 2]).min() < DISC_M


def test_walls_leave_no_gap():
    rng = np.random.default_rng(0)
    posts = wall(rng, np.array([[0.0, 0.0], [0.0, 20.0], [10.0, 20.0]]))
    step = np.hypot(*np.diff(posts[:, :2], axis=0).T)
    assert (step < posts[:-1, 2] + posts[1:, 2]).all()
    assert step.max() <= STEP_M + 1e-9


def test_a_field_without_room_is_refused():
    from scenarios.random_field.field import Keep

    with pytest.raises(ValueError, match="no room"):
        scattered(np.random.default_rng(0), 1, [Keep(0.0, 0.0, 500.0)])


# ---------------------------------------------------------------------- feasibility


def can(circles, start=(-40.0, 0.0, 0.0), goal=(40.0, 0.0), near_m=4.0):
    task = Task(start, goal, near_m, 60.0)
    return feasible(np.array(circles, dtype=float).reshape(-1, 3), task, DISC_M, R)


def ring(x, y, radius, first=0.0, last=2.0 * np.pi):
    count = int(np.ceil(radius * (last - first) / 1.5))
    at = np.linspace(first, last, count, endpoint=last - first < 6.28)
    return [(x + radius * np.cos(a), y + radius * np.sin(a), 1.0) for a in at]


def test_an_empty_field_can_be_crossed():
    assert can([])


def test_a_closed_ring_around_goal_or_start_cannot():
    assert not can(ring(40.0, 0.0, 12.0))
    assert not can(ring(-40.0, 0.0, 12.0))


def test_a_ring_with_a_door_can():
    assert can(ring(40.0, 0.0, 14.0, 0.5, 6.0))
    assert can(ring(-40.0, 0.0, 14.0, 0.6, 5.8))


def test_a_wall_with_a_gap_of_more_than_the_disc_can_and_with_less_cannot():
    def wall_with_gap(gap_m):
        y = np.arange(0.0, 70.0, 1.5) + 1.0 + 0.5 * gap_m
        return [(0.0, side * v, 1.0) for v in y for side in (-1.0, 1.0)]

    assert can(wall_with_gap(2.0 * DISC_M + 0.3))
    assert not can(wall_with_gap(2.0 * DISC_M - 0.1))


def test_a_pocket_that_only_reverse_leaves():
    """Nose to the end of a blind alley that is too narrow to turn in: only backwards is out."""
    alley = [(x, side * 3.0, 1.0) for x in np.arange(-54.0, -38.0, 1.5) for side in (-1.0, 1.0)]
    alley += [(-38.0, y, 1.0) for y in np.arange(-3.0, 3.1, 1.0)]
    assert can(alley, start=(-42.0, 0.0, 0.0))
    back = [(-54.0, y, 1.0) for y in np.arange(-3.0, 3.1, 1.0)]
    assert not can(alley + back, start=(-42.0, 0.0, 0.0))


def test_a_turn_tighter_than_the_plants_is_not_taken():
    """A bend of 2.3 m: a holonomic disc passes it, the plant cannot, not even with shunting."""
    posts = [(x, 1.35, 0.35) for x in np.arange(-45.0, -20.0, 0.5)]
    posts += [(x, -1.35, 0.35) for x in np.arange(-45.0, -17.4, 0.5)]
    posts += [(-20.0, y, 0.35) for y in np.arange(1.35, 30.0, 0.5)]
    posts += [(-17.3, y, 0.35) for y in np.arange(-1.35, 30.0, 0.5)]
    posts += [(-45.5, y, 0.35) for y in np.arange(-1.35, 1.4, 0.45)]
    assert not can(posts)
    assert not can(posts, start=(-25.0, 0.0, 0.0))
    assert can(posts, start=(-18.65, 20.0, np.pi / 2.0))


@pytest.mark.parametrize("density", [80, 160, 240, 400])
def test_random_fields_are_feasible(density):
    found = [build(seed, density=density).facts["feasible"] for seed in range(40)]
    assert np.mean(found) >= 0.97


@pytest.mark.parametrize("kind", ["traps", "forks"])
def test_most_traps_and_forks_have_a_way_out(kind):
    assert np.mean([build(seed, kind).facts["feasible"] for seed in range(30)]) >= 0.9


# ---------------------------------------------------------------------- a drive


def driven(ticks, seed=3):
    episode = Episode(build(seed), seed)
    for _ in range(ticks):
        episode.tick()
    return episode


def test_same_seed_same_digest_and_another_seed_another():
    assert driven(150).digest.hex() == driven(150).digest.hex()
    assert driven(150).digest.hex() != driven(150, seed=4).digest.hex()


def test_pickled_in_the_middle_it_goes_on_with_the_same_bits():
    episode = pickle.loads(pickle.dumps(driven(75)))
    for _ in range(75):
        episode.tick()
    assert episode.digest.hex() == driven(150).digest.hex()


def test_the_navigator_hears_scans_and_never_circles():
    episode = Episode(build(0), 0)
    known = vars(episode.navigator)
    assert not any("circle" in name or "world" in name for name in known)
    heard = episode.simulator.advance(episode.targets)
    for _ in range(10):
        heard += episode.simulator.advance(episode.targets)
    assert any(isinstance(m, LidarScan) for m in heard)
    centres = np.array([o.center_m[:2] for o in episode.course.world.obstacles])
    said = np.concatenate([
        np.ravel(value) for m in heard for value in vars(m).values()
        if isinstance(value, float | np.ndarray)
    ])  # fmt: skip
    assert not np.isin(np.ravel(centres), said).any()


@pytest.mark.parametrize("seed", [0, 3])
def test_it_reaches_the_goal_without_contact(seed):
    episode = driven(0, seed)
    while episode.outcome is None:
        episode.tick()
    figures = episode.figures()
    assert figures["outcome"] == "finished"
    assert figures["contacts"] == 0
    assert figures["min_clearance_m"] > 0.0
    assert figures["feasible"] is True
    assert figures["departures"] == 0
    goal = episode.course.waypoint_m[-1]
    assert np.hypot(*(episode.truth.position_m[:2] - goal)) < 4.0


# ---------------------------------------------------------------------- the command


def test_the_command_drives_a_field(monkeypatch, capsys, tmp_path):
    arguments = ["drive", "random_field", "--density", "160", "--seeds", "3-3", "--json"]
    monkeypatch.setattr(sys, "argv", ["ion", *arguments, "--out", str(tmp_path), "--log", "full"])
    with pytest.raises(SystemExit):
        main()
    result = json.loads(capsys.readouterr().out.splitlines()[0])
    assert (result["scenario"], result["density"], result["field"]) == (
        "random_field", 160, "circles"
    )  # fmt: skip
    assert result["feasible"] is True
    assert (tmp_path / "random_field_160_seed3.png").is_file()
    assert (tmp_path / "random_field_160_seed3.mcap").is_file()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (Options("nqe", density=80), "--density: the scenario 'nqe' takes no such option"),
        (Options("nqe", field="traps"), "--field: the scenario 'nqe' takes no such option"),
        (Options("random_field", density=-1), "--density -1: expected a whole number from 0 to"),
        (Options("random_field", field="mazes"), "--field mazes: expected one of circles, traps"),
    ],
)
def test_options_that_a_scenario_does_not_take_are_refused(options, said, tmp_path):
    from dataclasses import replace

    with pytest.raises(UsageError, match=said):
        job_of(replace(options, out=tmp_path))


def test_only_tapes_of_failures_are_kept_of_many_seeds(tmp_path):
    job = job_of(Options("random_field", seeds="3-3", out=tmp_path))
    assert job.drive(3)["log"] is None
    assert list(tmp_path.iterdir()) == []
    blind = job_of(Options("random_field", seeds="1-1", ablate=("blind",), out=tmp_path))
    result = blind.drive(1)
    assert result["outcome"] != "finished"
    assert {p.suffix for p in tmp_path.iterdir()} == {".mcap", ".png"}
