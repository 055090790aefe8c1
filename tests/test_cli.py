"""The command line: wrong input of each kind, and what a drive leaves behind."""

import json
import os
import signal
import subprocess
import sys
import time
from importlib.resources import files
from types import SimpleNamespace

import numpy as np
import pytest
from mcap.reader import make_reader

from ion.__main__ import main
from ion.drive.options import Options, job_of, seeds_of
from ion.errors import UsageError
from ion.job import Job
from ion.telling import as_json, line, summary
from scenarios.processor import fingerprint, fix_processor, settings
from tape.digest import Digest
from tape.reader import attachments, metadata, read

GOOD = [
    "1,34.900000,-117.000000,8,10,####,####,####",
    "2,34.900500,-117.000000,8,10,####,####,####",
    "3,34.901000,-117.000100,8,0,####,####,####",
]


def ion(monkeypatch, capsys, *arguments):
    """Run the command in this process: exit code, standard output, standard error."""
    monkeypatch.setattr(sys, "argv", ["ion", *map(str, arguments)])
    with pytest.raises(SystemExit) as ended:
        main()
    said = capsys.readouterr()
    return ended.value.code, said.out, said.err


def refused(monkeypatch, capsys, *arguments):
    """The one line of a refusal."""
    code, out, err = ion(monkeypatch, capsys, *arguments)
    assert (code, out, err.count("\n")) == (2, "", 1), err
    return err


BAD_ROUTES = {
    "a missing column": (2, "2,34.900500,-117.000000,8", "speed limit"),
    "a non-number": (2, "2,34.900500,east,8,10", "a number"),
    "a latitude out of range": (2, "2,94.900500,-117.000000,8,10", "-90 to 90"),
    "a negative width": (2, "2,34.900500,-117.000000,-8,10", "feet above 0"),
    "an infinite width": (2, "2,34.900500,-117.000000,inf,10", "feet above 0"),
    "no width": (2, "2,34.900500,-117.000000,nan,10", "feet above 0"),
    "a negative speed": (2, "2,34.900500,-117.000000,8,-10", "miles an hour"),
    "no speed": (2, "2,34.900500,-117.000000,8,nan", "miles an hour"),
    "waypoints out of order": (2, "4,34.900500,-117.000000,8,10", "expected 2"),
    "a zero-length segment": (2, "2,34.900000,-117.000000,8,10", "more than 0"),
    "a jump": (2, "2,35.900500,-117.000000,8,10", "at most 10000 m"),
}


@pytest.mark.parametrize("name", BAD_ROUTES)
def test_a_bad_route_is_one_line_with_file_line_and_expectation(
    name, monkeypatch, capsys, tmp_path
):
    number, wrong, expected = BAD_ROUTES[name]
    path = tmp_path / "bad.rddf"
    path.write_text("\n".join([*GOOD[: number - 1], wrong, *GOOD[number:]]))
    said = refused(monkeypatch, capsys, "drive", "--route", path, "--out", tmp_path)
    assert f"{path}, line {number}" in said
    assert expected in said


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"", "at least two waypoints"),
        (GOOD[0].encode(), "at least two waypoints"),
        (b"once upon a time", "is missing"),
        (b"\x89PNG\r\n\x1a\n\x00\xff", "expected lines of text"),
    ],
)
def test_what_is_no_route_file_is_refused(content, expected, monkeypatch, capsys, tmp_path):
    path = tmp_path / "bad.rddf"
    path.write_bytes(content)
    said = refused(monkeypatch, capsys, "drive", "--route", path, "--out", tmp_path)
    assert str(path) in said
    assert expected in said


def test_a_route_that_is_not_there_or_has_no_such_stretch(monkeypatch, capsys, tmp_path):
    path = tmp_path / "route.rddf"
    assert "cannot be read" in refused(monkeypatch, capsys, "drive", "--route", path)
    path.write_text("\n".join(GOOD))
    said = refused(monkeypatch, capsys, "drive", "--route", path, "--from", 2, "--to", 9)
    assert "from 1 to 3" in said


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["moon"], "there are: dead_end, "),
        ([], "scenarios: dead_end, "),
        (["nqe", "--route", "x"], "one of them"),
        (["nqe", "--from", "3"], "--from: the scenario 'nqe' takes no such option"),
        (["gc05_route", "--from", "9", "--to", "3"], "the first below the last"),
        (["nqe", "--ablate", "sight"], "blind, no-lidar"),
        (["nqe", "--fault", "gps mute 1s"], "no kind 'mute' of fault; known are silent"),
        (["nqe", "--fault", "gps silent"], "expected DEVICE KIND"),
        (["random_field", "--fault", "gps silent 1s"], "known are none"),
        (["nqe", "--seeds", "9-3"], "0-19"),
        (["nqe", "--seeds", "a"], "0-19"),
        (["nqe", "--seed", "-1"], "whole numbers"),
        (["nqe", "--jobs", "0"], "1 or more"),
    ],
)
def test_wrong_arguments_are_one_line(arguments, expected, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert expected in refused(monkeypatch, capsys, "drive", *arguments)


def test_unknown_options_are_refused(monkeypatch, capsys):
    code, _, err = ion(monkeypatch, capsys, "drive", "nqe", "--fly")
    assert code == 2
    assert "--fly" in err


def test_a_folder_that_cannot_be_written_is_named_before_the_start(monkeypatch, capsys, tmp_path):
    (tmp_path / "file").touch()
    said = refused(monkeypatch, capsys, "drive", "nqe", "--out", tmp_path / "file" / "runs")
    assert "cannot be written" in said
    assert str(tmp_path / "file" / "runs") in said


def test_seeds_are_ranges_and_lists():
    assert seeds_of(Options(seed=7)) == [7]
    assert seeds_of(Options(seeds="0-3")) == [0, 1, 2, 3]
    assert seeds_of(Options(seeds="1,4,7-9,4")) == [1, 4, 7, 8, 9]
    with pytest.raises(UsageError):
        seeds_of(Options(seeds="0-99999999999"))


def test_many_seeds_keep_the_tapes_of_failures_only_unless_told(tmp_path):
    assert job_of(Options("nqe", seeds="0-3", out=tmp_path)).failures_only
    assert not job_of(Options("nqe", seeds="0-3", out=tmp_path, log="full")).failures_only
    assert not job_of(Options("nqe", out=tmp_path)).failures_only


def test_files_are_named_after_scenario_ablations_and_seed(tmp_path):
    job = Job(job_of(Options("nqe", out=tmp_path)).source, tmp_path, ablate=("no-gps",))
    assert job.path(7, ".png") == tmp_path / "nqe_no-gps_seed7.png"


def test_json_is_one_line_and_strict():
    text = as_json({"a": 1.23456789, "b": None, "states": {"x": 0.30000000000000004}})
    assert json.loads(text) == {"a": 1.2346, "b": None, "states": {"x": 0.3}}
    with pytest.raises(ValueError, match="JSON compliant"):
        as_json({"a": float("inf")})


def test_a_summary_counts_and_names_what_failed():
    results = [{"seed": s, "outcome": o} for s, o in ((0, "finished"), (2, "contact"))]
    results.append({"seed": 1, "outcome": "error", "message": "ValueError: no"})
    counts = summary(results, 3.0)
    assert counts["summary"] is True
    assert (counts["episodes"], counts["finished"]) == (3, 1)
    assert counts["outcomes"] == {"contact": 1, "error": 1, "finished": 1}
    assert counts["failed_seeds"] == [1, 2]
    assert "ValueError: no" in line(results[-1])


def test_the_processor_is_fixed_where_the_user_has_not():
    environment = {"OPENBLAS_NUM_THREADS": "4"}
    fix_processor(environment)
    assert environment["OPENBLAS_NUM_THREADS"] == "4"
    assert set(settings()) <= set(environment)
    assert fingerprint()["numpy"] == np.__version__


@pytest.mark.skipif("NPY_DISABLE_CPU_FEATURES" not in settings(), reason="only on x86-64")
def test_numpy_takes_the_settings_without_a_warning():
    code = "import warnings; warnings.simplefilter('error'); import numpy"
    done = subprocess.run(
        [sys.executable, "-c", code], env=os.environ | settings(), capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr


PRODUCT = """
from scenarios.processor import fix_processor
fix_processor()
import numpy as np
a = np.random.default_rng(0).normal(size=(61, 61))
print((a @ a @ a).tobytes().hex())
"""


@pytest.mark.skipif("OPENBLAS_CORETYPE" not in settings(), reason="only on x86-64")
def test_a_product_has_the_same_bits_whatever_the_processor():
    """With AVX-512, OpenBLAS adds up in another order where nobody holds it back."""
    clean = {k: v for k, v in os.environ.items() if k not in settings()}
    found = {
        subprocess.run([sys.executable, "-c", PRODUCT], env=env, capture_output=True).stdout
        for env in (clean, clean | {"OPENBLAS_CORETYPE": "Zen"})
    }
    assert len(found) == 1
    assert all(found)


def tiny_route(path):
    lat = 34.9 + np.arange(3) * 0.0001
    rows = [f"{k + 1},{x:.7f},-117.0,12,{5 if k < 2 else 0}" for k, x in enumerate(lat)]
    path.write_text("\n".join(rows))
    return path


@pytest.fixture(scope="module")
def driven(tmp_path_factory):
    """A drive of 22 m, by the command, in another process."""
    folder = tmp_path_factory.mktemp("drive")
    route = tiny_route(folder / "tiny.rddf")
    command = [sys.executable, "-m", "ion", "drive", "--route", route, "--out", folder, "--json"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=files("ion").parent)
    return SimpleNamespace(code=done.returncode, out=done.stdout, err=done.stderr, folder=folder)


KEYS = """
scenario seed outcome sim_time_s wall_time_s real_time_factor distance_m gates_passed
gates_total contacts departures min_clearance_m cross_track_rms_m true_cross_track_rms_m
waypoints_passed waypoints_total states digest log
"""


def test_a_short_drive_gives_one_json_object_a_tape_and_a_map(driven):
    assert driven.code == 0, driven.err
    assert driven.out.count("\n") == 1
    result = json.loads(driven.out)
    assert [key for key in KEYS.split() if key not in result] == []
    assert result["outcome"] == "finished"
    assert result["log"] == str(driven.folder / "tiny_1-3_seed0.mcap")
    assert (driven.folder / "tiny_1-3_seed0.png").read_bytes()[1:4] == b"PNG"


def test_the_tape_of_a_drive_holds_what_is_needed_to_do_it_again(driven):
    result = json.loads(driven.out)
    digest = Digest()
    for item in read(result["log"]):
        digest.update(item)
    assert digest.hex() == result["digest"]
    found = attachments(result["log"])
    assert {"vehicle.toml", "states.toml"} <= set(found)
    assert any(name.endswith("tiny.rddf") for name in found)
    assert metadata(result["log"])["seed"] == "0"
    assert metadata(result["log"])["numpy"] == np.__version__


def test_the_same_seed_gives_the_same_digest_with_the_log_off(driven):
    route = driven.folder / "tiny.rddf"
    job = job_of(Options(route=route, out=driven.folder / "again", log="off"))
    result = job.drive(0)
    assert result["digest"] == json.loads(driven.out)["digest"]
    assert result["log"] is None
    assert not list((driven.folder / "again").glob("*.mcap"))


def test_ctrl_c_leaves_a_whole_tape_and_says_interrupted(tmp_path):
    command = [sys.executable, "-m", "ion", "drive", "nqe", "--out", tmp_path, "--json"]
    running = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=files("ion").parent
    )
    tape = tmp_path / "nqe_seed0.mcap"
    wait_for(lambda: tape.exists() and tape.stat().st_size > 300_000)
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=60)
    assert running.returncode == 130, err
    result = json.loads(out)
    assert result["outcome"] == "interrupted"
    with open(tape, "rb") as file:
        assert make_reader(file).get_summary() is not None
    digest = Digest()
    for item in read(tape):
        digest.update(item)
    assert digest.hex() == result["digest"]


def wait_for(happened, limit_s=60.0):
    end = time.monotonic() + limit_s
    while not happened():
        assert time.monotonic() < end
        time.sleep(0.1)
