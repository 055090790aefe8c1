"""The digest depends on what crossed the boundary, in order, and on nothing else."""

import hashlib
import pickle

import pytest

from nav.messages import CompassHeading, DirectCommand
from tape.digest import Digest
from tape.record import record
from tape.writer import MODES, TapeWriter

RECORDS = [record(10 * k, CompassHeading(k, k / 3)) for k in range(20)]


def digest_of(records):
    digest = Digest()
    for each in records:
        digest.update(each)
    return digest.hex()


def test_it_is_the_chain_that_it_says():
    one = record(7, DirectCommand(5, "stop_and_wait"))
    expected = hashlib.sha256(
        bytes(32) + b"/tape/direct_command" + (7).to_bytes(8, "little") + one.payload
    ).hexdigest()
    assert digest_of([one]) == expected


@pytest.mark.parametrize("mode", MODES)
def test_it_does_not_know_whether_a_tape_is_written(mode, tmp_path):
    digest = Digest()
    with TapeWriter(tmp_path / "run.mcap", mode=mode) as tape:
        for each in RECORDS:
            digest.update(each)
            tape.write(each)
    assert digest.hex() == digest_of(RECORDS)


def test_it_pickles_in_the_middle_and_goes_on():
    digest = Digest()
    for each in RECORDS[:7]:
        digest.update(each)
    digest = pickle.loads(pickle.dumps(digest))
    for each in RECORDS[7:]:
        digest.update(each)
    assert digest.hex() == digest_of(RECORDS)


@pytest.mark.parametrize(
    "changed",
    [
        RECORDS[:-1],
        [RECORDS[1], RECORDS[0], *RECORDS[2:]],
        [RECORDS[0]._replace(delivery_ns=1), *RECORDS[1:]],
        [record(0, CompassHeading(0, 5e-324)), *RECORDS[1:]],
        [RECORDS[0]._replace(topic="/tape/other"), *RECORDS[1:]],
    ],
    ids=["missing", "order", "delivery", "one_bit", "topic"],
)
def test_it_notices_any_change(changed):
    assert digest_of(changed) != digest_of(RECORDS)
