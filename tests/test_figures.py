"""`ion figures`: all nine on one page that asks nobody for anything."""

import re

import numpy as np
import pytest
from test_cli import ion, refused

from ion.figures import fig_6_05
from ion.figures.command import FIGURES
from ion.figures.page import Drawn, page
from ion.figures.stretch import START_M, around, stretch
from nav.route import rddf
from scenarios.nqe.course import build
from scenarios.parameter_files import parameters_of

NAMES = ["6.5", "6.6", "6.7", "6.8", "6.9", "6.10", "6.11", "6.12", "6.13"]
OUTSIDE = re.compile(r"""(https?:)?//[a-z]|<script|<link|@import|url\(""", re.IGNORECASE)


@pytest.fixture(scope="module")
def course():
    return build(0)


def test_every_figure_has_its_words():
    assert [figure.NAME for figure in FIGURES] == NAMES
    for figure in FIGURES:
        assert all(len(words) > 10 for words in (figure.TITLE, figure.SHOWS, figure.DIFFERS))


def test_a_page_holds_its_pictures_and_nothing_from_outside():
    text = page([Drawn(f.NAME, f.TITLE, f.SHOWS, f.DIFFERS, b"picture") for f in FIGURES])
    assert re.findall(r"<h2>Fig. (\S+)\.", text) == NAMES
    assert text.count('src="data:image/png;base64,') == 9
    assert text.count("src=") == 9
    assert not OUTSIDE.search(text)


def test_a_stretch_is_a_course_of_its_own(course):
    part = stretch(course, 40, 60)
    route = rddf.parse(part.route_text, part.route_name)
    assert len(route) == len(part.waypoint_m) == 21
    np.testing.assert_array_equal(part.waypoint_m[0], course.waypoint_m[40])
    x, y, heading = part.world.start
    along = START_M * np.array([np.cos(heading), np.sin(heading)])
    np.testing.assert_allclose(np.array([x, y]) - along, part.waypoint_m[0])
    assert part.gates == ()


def test_a_stretch_around_a_place_reaches_so_far(course):
    part = around(course, course.waypoint_m[100], 60.0, 40.0)
    before = np.hypot(*np.diff(course.waypoint_m[:101], axis=0).T)
    assert part.waypoint_m[-1].tolist() in course.waypoint_m.tolist()
    length = np.hypot(*np.diff(part.waypoint_m, axis=0).T).sum()
    assert abs(length - 100.0) < before.max() + 20.0


def test_the_curve_of_figure_6_5_goes_through_its_eight_points():
    from nav.route.smooth_path import catmull_rom

    curve = catmull_rom(fig_6_05.POINTS_M, 40)[0]
    assert len(fig_6_05.POINTS_M) == 8
    np.testing.assert_allclose(curve[::40], fig_6_05.POINTS_M, atol=1e-12)


def test_figures_of_membership_functions_need_no_drive():
    for figure in FIGURES:
        if figure.NAME in ("6.8", "6.9", "6.11"):
            drawn = figure.draw(None)
            assert len(drawn.axes) == 2
    assert parameters_of().speed.safe_distance_m > 0.0


def test_a_folder_that_cannot_be_written_is_refused(tmp_path, monkeypatch, capsys):
    (tmp_path / "file").touch()
    said = refused(monkeypatch, capsys, "figures", "--out", tmp_path / "file" / "x")
    assert "cannot be written" in said


@pytest.mark.slow
def test_the_whole_page(tmp_path, monkeypatch, capsys):
    code, out, err = ion(monkeypatch, capsys, "figures", "--out", tmp_path)
    assert code == 0, err
    assert out.rstrip() == f"figures: {tmp_path / 'figures.html'}"
    text = (tmp_path / "figures.html").read_text(encoding="utf-8")
    assert re.findall(r"<h2>Fig. (\S+)\.", text) == NAMES
    without = re.sub(r'src="data:image/png;base64,[A-Za-z0-9+/=]+"', "", text)
    assert "src=" not in without
    assert not OUTSIDE.search(without)
    assert 300_000 < len(text) < 10_000_000
