"""An exported page plays from a file, in a real browser, and asks nobody for anything."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from browser import chromium_page, picture

ION = str(Path(sys.executable).with_name("ion"))
SCENE = np.s_[200:550, :400, :3]


def export(tape, path, *more):
    command = [ION, "view", tape, "--export", str(path), *more]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


@pytest.fixture(scope="module")
def exported(short_tape, tmp_path_factory):
    path = tmp_path_factory.mktemp("exported") / "run.html"
    done = export(short_tape, path)
    assert done.returncode == 0, done.stderr
    assert re.fullmatch(rf"{path}: \d\.\d MB, 0\.0 to 17\.0 s\n", done.stdout)
    return path


@pytest.fixture(scope="module")
def page(exported):
    with chromium_page() as page:
        page.asked = []
        page.on("request", lambda r: page.asked.append(r.url))
        page.goto(f"file://{exported}")
        page.get_by_text("Path-Point Keeping since").first.wait_for()
        yield page


def time_s(page):
    return float(page.locator("#ion .words b").first.inner_text().removesuffix(" s"))


def until(page, reached):
    for _ in range(300):
        if reached(time_s(page)):
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"it stands at {time_s(page)} s")


def test_it_plays(page):
    before = time_s(page)
    until(page, lambda at_s: at_s > before + 0.5)
    picture(page, "exported", SCENE)


def test_an_event_is_gone_to_and_back(page, avoids_s):
    page.locator("#ion li", has_text="obstacle avoidance").click()
    until(page, lambda at_s: at_s == pytest.approx(avoids_s, abs=0.11))
    page.get_by_text(f"Obstacle Avoidance since {avoids_s:.1f} s").wait_for()
    late = picture(page, "exported_late", SCENE)
    page.locator("#ion li").first.click()
    until(page, lambda at_s: at_s < 3.0)
    page.wait_for_timeout(1000)
    assert np.abs(picture(page, "exported_early", SCENE) - late).mean() > 0.01


def test_it_says_what_was_left_out(page):
    page.get_by_text("about this page").click()
    page.get_by_text("point clouds at 2 Hz").wait_for()
    page.get_by_text("the trajectory as it grows").wait_for()
    page.get_by_text("ion drive dead_end --seed 0").wait_for()


def test_it_asks_nobody_and_complains_of_nothing(page):
    assert [url for url in page.asked if url.startswith(("http", "ws"))] == []
    assert page.errors == []


def test_a_part_is_smaller_and_says_so(short_tape, exported, tmp_path):
    path = tmp_path / "part.html"
    done = export(short_tape, path, "--from", "10", "--to", "12.5")
    assert "10.0 to 12.5 s" in done.stdout
    assert path.stat().st_size < exported.stat().st_size
    assert "the drive before 10.0 s and after 12.5 s" in path.read_text()


@pytest.mark.parametrize("asked", [("--from", "12", "--to", "9"), ("--to", "1e9")])
def test_what_is_not_on_the_tape_is_refused(short_tape, tmp_path, asked):
    done = export(short_tape, tmp_path / "no.html", *asked)
    assert done.returncode == 2
    assert re.fullmatch(r"ion: --from \S+ --to \S+: expected a part of 0 to .* s\n", done.stderr)
    assert not (tmp_path / "no.html").exists()


def test_a_folder_is_refused_under_its_own_option(short_tape, tmp_path):
    done = export(short_tape, tmp_path)
    assert done.returncode == 2
    assert done.stderr == f"ion: --export {tmp_path}: cannot be written: Is a directory\n"
