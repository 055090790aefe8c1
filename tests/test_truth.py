"""The twin against what is known of it: checks that can fail, their page, and real data."""

import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from browser import chromium_page

from scenarios.truth import CHECKS, Check, straight
from scenarios.truth.allan import allan_deviation
from scenarios.truth.check import Range
from twin import drivetrain

ION = str(Path(sys.executable).with_name("ion"))
LMS = Path(__file__).parents[2] / "shared" / "data" / "lms_static_20041210.npz"
QUICK = ("turning_circle", "lock_to_lock", "lidar_noise")


def truth(*arguments):
    command = [ION, "truth", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("name", CHECKS)
def test_every_check_holds(name):
    check = CHECKS[name]()
    assert check.holds, (check.twin, check.allowed)
    assert check.allowed.low < check.allowed.high
    assert check.source
    assert check.title


def test_a_vehicle_with_other_brakes_does_not_pass(monkeypatch):
    def feeble(parameters, brake):
        return [parameters.rolling_n_m + 0.5 * brake * b for b in parameters.brake_n_m]

    monkeypatch.setattr(drivetrain, "friction_torques", feeble)
    monkeypatch.setattr("twin.plant.friction_torques", feeble)
    assert not straight.braking().holds


def test_what_is_no_number_does_not_hold():
    check = Check("x", "m", float("nan"), Range(0.0, 1.0), "measured", "y")
    assert not check.holds
    assert not replace(check, twin=1.1).holds
    assert replace(check, twin=1.0).holds


def test_allan_deviation_of_white_noise_and_of_a_walk():
    rng, averaged = np.random.default_rng(0), np.array([1, 10, 100, 1000])
    white = allan_deviation(rng.standard_normal(200_000), 0.1, averaged)
    np.testing.assert_allclose(white, 1.0 / np.sqrt(averaged), rtol=0.15)
    steps = 0.01 * rng.standard_normal(200_000)
    walk = allan_deviation(np.cumsum(steps), 0.1, averaged)
    expected = 0.01 / np.sqrt(0.1) * np.sqrt(averaged * 0.1 / 3.0)
    np.testing.assert_allclose(walk[1:], expected[1:], rtol=0.3)


def test_the_command_writes_a_page_and_json(tmp_path):
    path = tmp_path / "truth.html"
    done = truth(*QUICK, "--out", path, "--json")
    assert done.returncode == 0, done.stderr
    said = [json.loads(line) for line in done.stdout.splitlines()]
    assert [each["check"] for each in said] == list(QUICK)
    assert all(each["holds"] for each in said)
    with chromium_page() as page:
        page.goto(f"file://{path}")
        assert page.locator("tr").count() == len(QUICK) + 1
        assert page.locator("figure img").count() == len(QUICK)
        page.get_by_text(f"{len(QUICK)} of {len(QUICK)} hold.").wait_for()
        assert page.errors == []


@pytest.mark.parametrize(("arguments", "complaint"), [
    (["radius"], "check 'radius' is unknown; there are: turning_circle, "),
    (["--out", "/proc/nothing/truth.html"], "--out /proc/nothing/truth.html: cannot be written"),
])  # fmt: skip
def test_bad_arguments(arguments, complaint):
    done = truth(*arguments)
    assert done.returncode == 2
    assert complaint in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert not re.search("Traceback", done.stderr)


@pytest.mark.skipif(not LMS.is_file(), reason=f"{LMS} is not here: real data is not committed")
def test_a_standing_scanner_is_as_noisy_as_the_real_one():
    """Beams whose neighbours see the same thing; an edge's are mixed pixels, and jump."""
    scans = np.load(LMS)["range_cm"][0::2, :180]  # of 180 beams; between them those of 181
    middle = np.median(scans, axis=0)
    beside = np.abs(np.diff(middle, append=middle[-1])) + np.abs(np.diff(middle, prepend=middle[0]))
    steady = (middle > 200) & (middle < 1600) & (beside < 20) & (np.ptp(scans, axis=0) < 10)
    assert np.count_nonzero(steady) > 20
    real_mm = 10.0 * np.sqrt(np.mean(scans[:, steady].var(axis=0)))
    assert CHECKS["lidar_noise"]().twin == pytest.approx(real_mm, abs=1.0)
    assert np.array_equal(scans, np.rint(scans))  # and the twin's check asserts its own counts
