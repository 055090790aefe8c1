"""A sensor that is silent has failed; one that stays so is given up until it speaks again."""

from nav.fusion.health import Health, HealthMonitor
from nav.parameters.states import HealthParameters

P = HealthParameters(devices=("gps",), silent_s=1.0, patience_s=10.0)


def monitor():
    return HealthMonitor(P, ("lidar", "gps"))


def at(m, seconds, **heard_s):
    return m.check(int(seconds * 1e9), {name: int(t * 1e9) for name, t in heard_s.items()})


def test_who_speaks_is_well():
    m = monitor()
    assert at(m, 0.0) == Health()
    assert at(m, 5.0, lidar=4.5, gps=4.1) == Health()


def test_who_is_silent_fails_and_recovers():
    m = monitor()
    at(m, 0.0)
    assert at(m, 2.0, lidar=1.9, gps=0.5) == Health(failed=("gps",))
    assert at(m, 3.0, lidar=2.9, gps=2.9) == Health()


def test_who_never_spoke_fails_too():
    m = monitor()
    at(m, 0.0)
    assert at(m, 1.5, lidar=1.4).failed == ("gps",)


def test_patience_ends_and_begins_anew():
    m = monitor()
    at(m, 0.0)
    at(m, 2.0, gps=2.0)
    assert at(m, 11.9, gps=11.9) == Health(failed=("lidar",))
    assert at(m, 12.1, gps=12.1) == Health(lost=("lidar",))
    assert at(m, 13.0, gps=13.0, lidar=12.9) == Health()
    assert at(m, 15.0, gps=15.0, lidar=12.9) == Health(failed=("lidar",))


def test_a_helper_is_missed_and_neither_fails_nor_is_lost():
    m = HealthMonitor(P, ("gps",), ("radar",))
    assert at(m, 0.0, gps=0.0) == Health()
    for seconds in (1.5, 20.0):
        assert at(m, seconds, gps=seconds) == Health(missed=("radar",))
    assert at(m, 21.0, gps=21.0, radar=20.9) == Health()
