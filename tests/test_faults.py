"""Sensors that fall silent, and what a reset does."""

from twin.faults import Fault, Faults

S = 10**9


def test_a_fault_has_a_beginning_and_an_end():
    faults = Faults((Fault("gps", "silent", 2.0, 5.0),))
    heard = [not faults.silent(t * S, "gps") for t in (1, 2, 4, 5)]
    assert heard == [True, False, False, True]
    assert not faults.silent(3 * S, "imu")


def test_a_reset_helps_after_a_while():
    faults = Faults((Fault("gps", "silent", 2.0, recovers_s=3.0),))
    faults.reset(1 * S, "gps")  # before it fails, nothing can be mended
    assert faults.silent(6 * S, "gps")
    faults.reset(6 * S, "gps")
    faults.reset(8 * S, "gps")  # the first one is under way
    assert faults.silent(8 * S, "gps")
    assert not faults.silent(9 * S, "gps")


def test_some_faults_stay():
    faults = Faults((Fault("gps", "silent", 0.0),))
    faults.reset(1 * S, "gps")
    assert faults.silent(1000 * S, "gps")
