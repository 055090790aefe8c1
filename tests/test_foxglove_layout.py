"""Every topic and every path of the layout is on a tape; every panel has its place."""

import json
from importlib.resources import files

import pytest
from mcap.reader import make_reader

from ion.__main__ import main
from tape.reader import read_packed
from tape.schemas import wire_class

TEXT = (files("tape") / "foxglove_layout.json").read_text(encoding="utf-8")
LAYOUT = json.loads(TEXT)


def panels(node):
    """The identifiers in a tree of panels."""
    if isinstance(node, str):
        return [node]
    return panels(node["first"]) + panels(node["second"])


def paths():
    return [path["value"] for p in LAYOUT["configById"].values() for path in p.get("paths", ())]


@pytest.fixture(scope="module")
def tape(short_tape):
    """Topics, and the fields of those below /tape/."""
    with open(short_tape, "rb") as file:
        summary = make_reader(file).get_summary()
    fields = {item.topic: wire_class(item.kind).DESCRIPTOR for item in read_packed(short_tape)}
    return {c.topic for c in summary.channels.values()}, fields


def test_every_panel_is_configured_once():
    assert sorted(panels(LAYOUT["layout"])) == sorted(LAYOUT["configById"])


def test_every_topic_is_on_the_tape(tape):
    scene = LAYOUT["configById"]["3D!scene"]["topics"]
    named = [*scene, LAYOUT["configById"]["RosOut!log"]["topicToRender"], "/view/gps"]
    assert set(named) <= tape[0]
    drawn = {t for t in tape[0] if t.startswith("/view/")}
    assert drawn - set(named) == {"/view/frames", "/view/mountings"}  # transforms: always taken


@pytest.mark.parametrize("path", paths())
def test_every_path_is_a_field(tape, path):
    topic, field = path.split(".")
    assert field in tape[1][topic].fields_by_name


def test_it_can_be_had_from_the_command(capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["ion", "layout"])
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 0
    assert json.loads(capsys.readouterr().out) == LAYOUT
