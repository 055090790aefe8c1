"""`ion route`: the numbers and the picture of a route file."""

import json

import pytest
from test_cli import refused
from test_route_course import straight_route

from ion.__main__ import main


def ran(monkeypatch, capsys, *arguments):
    monkeypatch.setattr("sys.argv", ["ion", "route", *map(str, arguments)])
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 0
    return capsys.readouterr().out


def test_a_file_is_told_and_drawn(monkeypatch, capsys, tmp_path):
    path, out = tmp_path / "r.rddf", tmp_path / "pictures" / "r.png"
    path.write_text(straight_route(12, 60.0, 12.0))
    said = json.loads(ran(monkeypatch, capsys, path, "--json", "--out", out))
    assert said["waypoints"] == 12
    assert said["mean_spacing_m"] == pytest.approx(60.0, abs=1e-3)
    assert said["speed_share"] == {"25": 1.0}
    assert said["half_width_ft"]["median"] == pytest.approx(12.0)
    assert said["sharp_turns"] == 0
    assert out.read_bytes().startswith(b"\x89PNG")
    assert "660" not in ran(monkeypatch, capsys, path, "--out", out)


def test_the_race_can_be_written_as_a_file(monkeypatch, capsys, tmp_path):
    path, out = tmp_path / "gc05.rddf", tmp_path / "r.png"
    told = ran(monkeypatch, capsys, "gc05_route", "--write", path, "--out", out)
    assert "131.60 miles" in told
    said = json.loads(ran(monkeypatch, capsys, path, "--json", "--out", out))
    assert said["waypoints"] == 2935


def test_wrong_files_are_one_line(monkeypatch, capsys, tmp_path):
    assert "cannot be read" in refused(monkeypatch, capsys, "route", tmp_path / "none")
    path = tmp_path / "words.txt"
    path.write_text("words")
    assert "latitude is missing" in refused(monkeypatch, capsys, "route", path)
    path.write_text(straight_route(3))
    bad = path / "below" / "r.png"
    assert "--out" in refused(monkeypatch, capsys, "route", path, "--out", bad)
