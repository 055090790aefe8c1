"""`ion report`: one drive as one page, from its tape alone."""

import re
import subprocess
import sys
from base64 import b64decode
from itertools import pairwise
from pathlib import Path

import pytest

from ion.courses import scenario_source
from ion.job import Job
from ion.recorded import recorded
from ion.report.command import KILLED, NO_TRUTH, told
from ion.report.page import page
from ion.report.series import Series
from nav.messages import Decision
from tape.truth import TrueState


def driven(folder: Path, log: str) -> Path:
    source = scenario_source("random_field", {"density": 20})
    return Path(Job(source, folder, log).drive(3)["log"])


@pytest.fixture(scope="module")
def full(tmp_path_factory) -> Path:
    return driven(tmp_path_factory.mktemp("full"), "full")


def ion(*words) -> subprocess.CompletedProcess:
    command = [sys.executable, "-m", "ion", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_page_tells_the_drive_and_asks_nobody(full):
    done = ion("report", full)
    assert done.returncode == 0, done.stderr
    path = full.with_suffix(".html")
    assert done.stdout == f"report: {path}\n"
    text = path.read_text()
    assert recorded(full).figures["digest"] in text
    assert "ion drive random_field --density 20 --seed 3" in text
    assert "path point keeping: start" in text
    pictures = re.findall(r'src="data:image/png;base64,([^"]+)"', text)
    assert [b64decode(data)[:4] for data in pictures] == [b"\x89PNG"] * 2
    assert not re.search(r'(src|href)="(?!data:)', text)


def test_columns_are_those_of_the_tape(full):
    series = Series(full)
    assert series.end_s == pytest.approx(recorded(full).figures["sim_time_s"])
    assert len(series.times(Decision)) == len(series.states) > 100
    assert series.of(TrueState, "position_m").shape == (len(series.times(TrueState)), 3)
    spans = series.spans()
    assert all(one[1] == pytest.approx(after[0]) for one, after in pairwise(spans))


def test_without_truth_the_map_shows_what_was_believed(tmp_path):
    log = driven(tmp_path, "inputs")
    found = told(recorded(log), Series(log))
    assert found.left_out == NO_TRUTH
    assert found.map_png


def test_a_killed_drive_has_a_page(full, tmp_path):
    log = tmp_path / "killed.mcap"
    log.write_bytes(full.read_bytes()[: full.stat().st_size // 2])
    found = told(recorded(log), Series(log))
    assert found.left_out == KILLED
    assert not found.good
    assert "None on the tape" in page(found)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["missing.mcap"], "missing.mcap: cannot be read"),
        ([__file__], "not a tape"),
        (["{full}", "--out", "{full}"], "is the tape itself"),
        (["{full}", "--out", "/proc/no/page.html"], "cannot be written"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(full, words, said):
    done = ion("report", *(word.format(full=full) for word in words))
    assert done.returncode == 2
    assert done.stderr.startswith("ion: ")
    assert said in done.stderr
    assert done.stderr.count("\n") == 1
