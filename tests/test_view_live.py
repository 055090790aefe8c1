"""`ion drive --view`: the page of a drive while it is driven changes nothing of it."""

import json
import re
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

ION = str(Path(sys.executable).with_name("ion"))
DRIVE = ["drive", "random_field", "--seed", "3", "--json", "--out"]


@pytest.fixture
def viewed(tmp_path):
    """The process, the page's address, and the folder."""
    command = [ION, *DRIVE, str(tmp_path), "--view"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    line = process.stdout.readline()
    found = re.match(r"(http://127\.0\.0\.1:\d+) ", line)
    assert found, line + process.stderr.read()
    yield process, found[1]
    process.kill()
    process.wait()


def test_the_drive_is_the_same_and_the_page_stays(viewed, tmp_path):
    process, address = viewed
    with urllib.request.urlopen(address) as answer:
        assert answer.status == 200
    result = json.loads(process.stdout.readline())
    assert process.stdout.readline().startswith("the page stays")
    with urllib.request.urlopen(address) as answer:
        assert answer.status == 200
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=20) == 0
    plain = subprocess.run([ION, *DRIVE, str(tmp_path / "plain")], capture_output=True, check=True)
    assert json.loads(plain.stdout)["digest"] == result["digest"]


def test_many_seeds_have_no_page():
    command = [ION, "drive", "random_field", "--seeds", "0-2", "--view"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert done.stderr == "ion: --view: expected one drive, --seed N, not --seeds\n"
