"""`ion bench`: its figures, what they are measured on, and what it refuses."""

import json
from dataclasses import asdict
from math import isfinite

import mujoco
import numpy as np
import pytest
from test_cli import ion, refused

from ion.bench import embree
from ion.bench.bare import Bare
from ion.bench.beams import Cost, ours, scans_of, theirs
from ion.bench.embree import Embree, is_installed, mesh
from ion.bench.figures import figures
from ion.bench.meter import metering
from ion.bench.parts import PARTS, shares
from ion.bench.race import Slice, cut, race
from scenarios.episode import Episode
from scenarios.nqe import build
from twin.plant import Plant

KEYS = ["full_over_bare", "embree_over_ours", "lidar_us_per_ray", "real_time_factor", "parts"]
SHARES = dict.fromkeys(PARTS, 1.0 / len(PARTS))
needs_embree = pytest.mark.skipif(not is_installed(), reason="needs the extra `bench`: embreex")


@pytest.fixture
def episode():
    """An NQE, just begun."""
    episode = Episode(build(0), 0)
    for _ in range(5):
        episode.tick()
    return episode


def positive(value):
    return isfinite(value) and value > 0.0


def test_the_json_is_one_object_of_positive_numbers(monkeypatch, capsys):
    code, out, err = ion(monkeypatch, capsys, "bench", "--seconds", 0.2, "--json")
    said = json.loads(out)
    assert (code, list(said), list(said["parts"])) == (0, KEYS, list(PARTS))
    parts, ratio = said.pop("parts"), said.pop("embree_over_ours")
    assert all(positive(value) for value in (*said.values(), *parts.values()))
    assert sum(parts.values()) == pytest.approx(1e3 / said["real_time_factor"])
    assert positive(ratio) if is_installed() else ratio is None
    assert err == "" if is_installed() else embree.MISSING in err


def test_without_embree_one_line_says_what_is_missing(monkeypatch, capsys):
    monkeypatch.setattr(embree, "is_installed", lambda: False)
    code, out, err = ion(monkeypatch, capsys, "bench", "--seconds", 0.1, "--json")
    assert (code, err.count("\n")) == (0, 1)
    assert "ion-twin[bench]" in err
    assert json.loads(out)["embree_over_ours"] is None


def test_another_scenario_as_a_table(monkeypatch, capsys):
    code, out, _ = ion(monkeypatch, capsys, "bench", "small_robot", "--seconds", 0.1)
    assert code == 0
    assert all(part.replace("_", " ") in out for part in PARTS)


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["nowhere"], "there are: "),
        (["random_field"], "without MuJoCo"),
        (["--seed", -1], "expected a whole number from 0 to"),
        (["--seed", 2**32], "expected a whole number from 0 to"),
        (["--seconds", 0], "expected 0.02 or more"),
        (["--seconds", -3], "expected 0.02 or more"),
        (["--seconds", "nan"], "expected 0.02 or more"),
        (["--seconds", "inf"], "expected 0.02 or more"),
    ],
)
def test_wrong_arguments_are_refused_in_one_line(arguments, expected, monkeypatch, capsys):
    assert expected in refused(monkeypatch, capsys, "bench", *arguments)


@pytest.mark.parametrize(
    ("ticks", "slices"), [(1, [1]), (50, [50]), (51, [25, 26]), (150, [50] * 3)]
)
def test_a_drive_is_cut_into_slices_of_a_second_at_most(ticks, slices):
    assert cut(ticks) == slices


def test_a_race_does_not_change_the_drive(episode):
    alone = Episode(build(0), 0)
    for _ in range(11):
        alone.tick()
    raced = list(race(episode, episode.simulator, [3, 3], with_embree=False))
    assert len(raced) == 2
    assert episode.digest.hex() == alone.digest.hex()


def test_a_drive_that_ends_leaves_out_the_rest(episode):
    episode.judge.outcome = "finished"
    assert list(race(episode, episode.simulator, [3, 3], with_embree=False)) == []


def test_figures_are_medians_over_the_slices():
    slices = [Slice(2.0, 1.0, Cost(1e-6, 3e-6)), Slice(9.0, 3.0, Cost(2e-6, 4e-6))]
    found = asdict(figures([50, 50, 50], [*slices, Slice(4.0, 1.0, Cost(1e-6, 2e-6))], SHARES))
    assert found.pop("parts") == pytest.approx(dict.fromkeys(PARTS, 4e3 / len(PARTS)))
    assert list(found.values()) == pytest.approx([3.0, 2.0, 1.0, 0.25])


def test_parts_are_shares_of_the_whole_and_leave_no_meter_behind(episode):
    plain = Episode.tick
    found = shares(episode, 5)
    assert sum(found.values()) == pytest.approx(1.0)
    assert all(share > 0.0 for share in found.values())
    assert Episode.tick is plain


def test_a_part_is_not_charged_for_what_another_part_does():
    class Work:
        def outer(self):
            return self.inner()

        def inner(self):
            return sum(range(100_000))

    with metering({"outer": [(Work, "outer")], "inner": [(Work, "inner")]}) as meter:
        Work().outer()
        meter.switch("rest")
    assert meter.spent_s["inner"] > meter.spent_s["outer"] > 0.0


def test_bare_physics_is_stock_mujoco_of_the_same_state(episode):
    plant = episode.simulator.plant
    assert isinstance(plant, Plant)
    k, before, bare = plant.k, plant.data.qpos.copy(), Bare(plant)
    expected = Bare(plant)
    expected._model.geom_user[:] = 0.0  # no tire is marked as ours
    mujoco.mj_step(expected._model, expected._data, 30)
    bare.wall_s(30)
    assert np.array_equal(bare._data.qpos, expected._data.qpos)
    ours_then = Bare(plant)
    mujoco.mj_step(ours_then._model, ours_then._data, 30)
    assert not np.array_equal(ours_then._data.qpos, expected._data.qpos)
    assert plant.k == k
    assert np.array_equal(plant.data.qpos, before)


@needs_embree
def test_embree_sees_what_our_rays_see(episode):
    for _ in range(300):
        episode.tick()
    solid, scans = episode.simulator.sight.solid, scans_of(episode.simulator)
    assert [len(scan.origins) for scan in scans] == [361] * 4
    scene = Embree(solid.geometry)
    for scan in scans:
        mine, other = ours(solid, scan)[:, 0], theirs(scene, scan)
        assert np.mean(np.abs(mine - other) < 0.05) > 0.98
    assert any((ours(solid, scan) < scan.max_range_m).mean() > 0.3 for scan in scans)


def test_the_mesh_holds_each_solid_within_its_reach(episode):
    geometry = episode.simulator.sight.solid.geometry
    vertices, triangles = mesh(geometry)
    n = len(geometry.ground.z)
    assert len(np.unique(triangles)) == len(vertices)
    assert np.array_equal(vertices[: n * n, 2].reshape(n, n), geometry.ground.z)
    start = n * n
    for i in np.unique(geometry.members):
        solid = geometry.solids[i]
        count = 8 if solid["shape"] == 0 else 2 * embree.SIDES
        own = vertices[start : start + count]
        assert np.allclose(own.max(axis=0) - solid["center"], solid["reach"], rtol=0.01, atol=1e-6)
        start += count
    assert start == len(vertices)
