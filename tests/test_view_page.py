"""The page of `ion view` in a real browser: it is drawn, plays, scrubs, jumps and looks around."""

import re
import signal
import subprocess
import sys
from pathlib import Path

import browser
import numpy as np
import pytest
from browser import PATIENCE_MS, chromium_page

ION = str(Path(sys.executable).with_name("ion"))
SCENE = np.s_[200:590, :400, :3]
"""What of the page is surely scene: left of the panel, below notices."""


@pytest.fixture(scope="module")
def viewer(short_tape, tmp_path_factory):
    """A running `ion view`: its process and its address."""
    folder = str(tmp_path_factory.mktemp("tuned"))
    command = [ION, "view", short_tape, "--host", "127.0.0.1", "--parameters", folder]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    line = process.stdout.readline()
    found = re.match(r"(http://127\.0\.0\.1:\d+) ", line)
    assert found, line + process.stderr.read()
    process.folder = Path(folder)
    yield process, found[1]
    process.kill()
    process.wait()


@pytest.fixture(scope="module")
def page(viewer):
    with chromium_page() as page:
        page.goto(viewer[1])
        page.get_by_text("Path-Point Keeping").first.wait_for()
        yield page


def picture(page, name):
    """What the scene shows, shape (h, w, 3)."""
    return browser.picture(page, name, SCENE)


def clock(page):
    return page.locator("input[inputmode=decimal]").first


def time_s(page):
    return float(clock(page).input_value())


def scrub(page, to_s):
    """Set the clock, and wait until that moment is shown: the next click could overtake it."""
    clock(page).fill(str(to_s))
    clock(page).press("Enter")
    shows(page, f"{to_s:.1f} s:")


def until(page, reached):
    """Wait for the clock."""
    for _ in range(PATIENCE_MS // 100):
        if reached(time_s(page)):
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"the clock stands at {time_s(page)} s")


def shows(page, text):
    page.get_by_text(text).first.wait_for()


def choose(page, label, option):
    """From a list."""
    beside = page.get_by_text(label, exact=True).locator("xpath=following::input[@role='combobox']")
    beside.first.click()
    page.get_by_role("option", name=option).click()


def press(page, label, button):
    """A button in the row of a label."""
    row = page.get_by_text(label, exact=True).locator("xpath=ancestor::*[.//button][1]")
    row.get_by_role("button", name=button).click()


def test_scene_is_drawn(page):
    for _ in range(20):  # it fades in
        colors = np.round(picture(page, "start") * 32).reshape(-1, 3)
        if len(np.unique(colors, axis=0)) > 20:
            return
        page.wait_for_timeout(500)
    raise AssertionError("the scene stays empty: see runs/screens/start.png")


def test_scrubbing_shows_that_moment(page, avoids_s):
    before = picture(page, "before")
    scrub(page, 16)
    shows(page, f"Obstacle Avoidance since {avoids_s:.1f} s")
    page.wait_for_timeout(1000)
    assert np.abs(picture(page, "scrubbed") - before).mean() > 0.01


def test_playing_moves_time(page):
    scrub(page, 5)
    page.get_by_role("button", name="Play").click()
    until(page, lambda at_s: at_s > 6.0)
    page.get_by_role("button", name="Pause").click()
    page.get_by_role("button", name="Play").wait_for()
    assert 6.0 < time_s(page) < 17.1


def test_next_event_is_where_it_happened(page, avoids_s):
    scrub(page, 5)
    press(page, "event", "next")
    shows(page, f"{avoids_s:.1f} s: obstacle avoidance: obstacle on the smooth path")
    until(page, lambda at_s: at_s == pytest.approx(avoids_s))
    press(page, "decision", "forward")
    until(page, lambda at_s: at_s == pytest.approx(avoids_s + 0.1))


def test_cameras_show_different_pictures(page):
    scrub(page, 16)
    seen = []
    for camera in ("above", "driver's seat"):
        choose(page, "camera", camera)
        page.wait_for_timeout(1000)
        seen.append(picture(page, camera.split("'")[0]))
    assert np.abs(seen[0] - seen[1]).mean() > 0.02


def tuned(page, term, points):
    """Type the breakpoints of a term."""
    page.get_by_text(f"{term} =", exact=True).locator("xpath=following::input[1]").fill(points)


def test_a_breakpoint_changes_the_decision(page):
    scrub(page, 16.7)
    shows(page, "16.7 s:")
    page.get_by_text("tune", exact=True).click()
    choose(page, "variable", "speed: anti_collision, D1_m")
    tuned(page, "DA", "4.0, 3.0")
    shows(page, "must increase strictly")
    tuned(page, "M", "7.0, 20.0, 29.0")
    shows(page, re.compile(r"Tuned:.*(it would have decided|would have steered)"))
    picture(page, "tuned")


def test_the_rest_of_the_run_is_driven_again(page, viewer):
    page.get_by_role("button", name="Rest of the run").click()
    shows(page, re.compile(r"As tuned, from 16.7 s on"))


def test_what_was_tuned_is_shown_and_saved(page, viewer):
    page.get_by_role("button", name="Show what changed").click()
    shows(page, re.compile("speed.toml as tuned"))
    page.get_by_role("button", name="Write it").click()
    shows(page, "Written:")
    assert "points = [7.0, 20.0, 29.0]" in (viewer[0].folder / "speed.toml").read_text()


def test_browser_has_nothing_to_complain_about(page):
    assert page.errors == []


def test_interrupt_ends_it_quietly(viewer):
    process, _ = viewer
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert process.returncode in (0, 130)
    assert "Traceback" not in errors


def test_a_foreign_file_is_refused_in_one_line(tmp_path):
    log = tmp_path / "foreign.mcap"
    log.write_text("no tape")
    done = subprocess.run([ION, "view", log], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert re.fullmatch(r"ion: .*not a tape; expected .*\n", done.stderr)
