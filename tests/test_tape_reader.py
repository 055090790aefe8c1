"""A tape is read as far as it goes; what is no tape is refused in one line."""

import io

import pytest
from mcap.writer import Writer

from nav.messages import CompassHeading, DirectCommand
from tape.errors import TapeError
from tape.reader import attachments, metadata, read
from tape.record import record
from tape.writer import TapeWriter

RECORDS = [record(k * 10**8, CompassHeading(k * 10**8, k / 7)) for k in range(50)]
"""Five seconds, so five chunks."""


@pytest.fixture
def tape(tmp_path):
    path = tmp_path / "run.mcap"
    with TapeWriter(path, {"a.toml": "x = 1"}, {"seed": "3"}) as writer:
        for each in RECORDS:
            writer.write(each)
    return path


def payloads(records):
    return [r.payload for r in records]


def test_wherever_the_end_is_cut_off_the_beginning_is_read(tape):
    whole = tape.read_bytes()
    expected, lengths = payloads(RECORDS), set()
    for cut in range(len(whole) - 1, len(whole) // 5, -97):
        tape.write_bytes(whole[:cut])
        got = payloads(read(tape))
        assert got == expected[: len(got)]
        lengths.add(len(got))
    assert lengths == {10, 20, 30, 40, 50}


def test_a_cut_tape_still_has_its_attachments(tape):
    whole = tape.read_bytes()
    tape.write_bytes(whole[: len(whole) // 2])
    assert attachments(tape) == {"a.toml": b"x = 1"}
    assert metadata(tape) == {"seed": "3"}


def test_late_attachments_are_found(tmp_path):
    with TapeWriter(tmp_path / "run.mcap") as writer:
        writer.write(RECORDS[0])
        writer.attach("summary.json", "{}")
    assert attachments(tmp_path / "run.mcap") == {"summary.json": b"{}"}
    assert metadata(tmp_path / "run.mcap") == {}


@pytest.mark.parametrize("content", [b"", b"hello", b"seed = 3\n" * 100], ids=len)
def test_a_foreign_file_is_refused(content, tmp_path):
    path = tmp_path / "run.mcap"
    path.write_bytes(content)
    with pytest.raises(TapeError, match=r"run\.mcap: not a tape; expected an MCAP file") as error:
        list(read(path))
    assert "\n" not in str(error.value)


def test_an_mcap_file_of_others_is_refused(tmp_path):
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start(profile="ros2")
    writer.finish()
    (tmp_path / "ros.mcap").write_bytes(stream.getvalue())
    with pytest.raises(TapeError, match="profile 'ros2', expected 'ion-tape'"):
        list(read(tmp_path / "ros.mcap"))


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(TapeError, match=r"none\.mcap: cannot be read: No such file"):
        list(read(tmp_path / "none.mcap"))


def test_damage_before_the_end_is_refused(tape):
    content = bytearray(tape.read_bytes())
    middle = content.index(b"\x28\xb5\x2f\xfd", len(content) // 3)  # a zstd frame begins
    content[middle + 20] ^= 0x55
    tape.write_bytes(content)
    with pytest.raises(TapeError, match=r"run\.mcap: damaged"):
        list(read(tape))


def test_a_hole_in_a_closed_file_is_refused(tape):
    content = tape.read_bytes()
    start = content.index(b"\x28\xb5\x2f\xfd")
    tape.write_bytes(content[: start - 8] + (10**9).to_bytes(8, "little") + content[start:])
    with pytest.raises(TapeError, match="damaged"):
        list(read(tape))


def test_a_message_type_that_is_unknown_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("tape.writer.schema_name", lambda kind: "ion.Horoscope")
    with TapeWriter(tmp_path / "run.mcap") as writer:
        writer.write(record(0, DirectCommand(0, "stop_and_wait")))
    with pytest.raises(TapeError, match=r"ion\.Horoscope, which is unknown; known are ion\.Lidar"):
        list(read(tmp_path / "run.mcap"))
