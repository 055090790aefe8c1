"""A tape that may not be wanted."""

import pytest

from nav.messages import CompassHeading
from tape.held_back import HeldBack
from tape.reader import read
from tape.record import record
from tape.writer import TapeWriter


def records(count):
    return [record(k * 20_000_000, CompassHeading(k, 0.1 * k)) for k in range(count)]


def payloads(path):
    return [(r.topic, r.delivery_ns, r.message.heading_rad) for r in read(path)]


def test_it_opens_no_file_until_it_is_wanted(tmp_path):
    path = tmp_path / "tape.mcap"
    with HeldBack(lambda: TapeWriter(path)) as tape:
        for item in records(5):
            tape.write(item)
    assert not path.exists()


def test_what_waited_is_written_when_it_is_wanted(tmp_path):
    held, plain = tmp_path / "held.mcap", tmp_path / "plain.mcap"
    with HeldBack(lambda: TapeWriter(held)) as tape:
        for item in records(5):
            tape.write(item)
        tape.keep()
        tape.keep()
    with TapeWriter(plain) as writer:
        for item in records(5):
            writer.write(item)
    assert payloads(held) == payloads(plain)
    assert len(payloads(held)) == 5


@pytest.mark.parametrize("most", [0, 3])
def test_a_long_drive_goes_to_its_file(tmp_path, most):
    path = tmp_path / "tape.mcap"
    with HeldBack(lambda: TapeWriter(path), most) as tape:
        assert path.exists() == (most == 0)
        for item in records(6):
            tape.write(item)
        assert path.exists()
    assert len(payloads(path)) == 6


def test_a_drive_that_breaks_leaves_its_tape(tmp_path):
    path = tmp_path / "tape.mcap"
    tape = HeldBack(lambda: TapeWriter(path))
    tape.write(records(1)[0])
    tape.__exit__(RuntimeError, RuntimeError("broken"), None)
    assert len(payloads(path)) == 1
