"""A sensor that is silent has failed; one that stays so is given up until it speaks again."""

from nav.fusion.health import Health, HealthMonitor
from nav.parameters.states import HealthParameters

P = HealthParameters(
    devices=("gps",), silent_s=1.0, patience_s=10.0, vital=("gps",), often=3, often_s=60.0,
    steady_s=30.0,
)  # fmt: skip


def monitor():
    return HealthMonitor(P, ("lidar", "gps"))


def at(m, seconds, doubted=(), **heard_s):
    heard_ns = {name: int(t * 1e9) for name, t in heard_s.items()}
    return m.check(int(seconds * 1e9), heard_ns, doubted)


def test_who_speaks_is_well():
    m = monitor()
    assert at(m, 0.0) == Health()
    assert at(m, 5.0, lidar=4.5, gps=4.1) == Health()


def test_who_is_silent_fails_and_recovers():
    m = monitor()
    at(m, 0.0)
    assert at(m, 2.0, lidar=0.5, gps=1.9) == Health(failed=("lidar",))
    assert at(m, 3.0, lidar=2.9, gps=2.9) == Health()


def test_what_it_cannot_drive_without_must_be_steady_before_it_is_trusted_again():
    m = monitor()
    at(m, 0.0)
    assert at(m, 2.0, lidar=1.9, gps=0.5) == Health(failed=("gps",), unfit="gps")
    assert at(m, 3.0, lidar=2.9, gps=2.9).unfit == "gps"
    assert at(m, 33.0, lidar=32.9, gps=32.9) == Health()


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


def test_who_is_doubted_has_failed_at_once():
    m = monitor()
    at(m, 0.0)
    assert at(m, 0.5, doubted={"lidar": "noisy"}, lidar=0.5, gps=0.5).failed == ("lidar",)


def test_who_fails_again_and_again_is_given_up_until_it_is_steady():
    m = monitor()
    at(m, 0.0)
    for t in (2.0, 6.0):
        assert at(m, t, lidar=t - 1.5, gps=t).failed == ("lidar",)
        assert at(m, t + 1.0, lidar=t + 1.0, gps=t + 1.0) == Health()
    assert at(m, 10.0, lidar=8.5, gps=10.0).lost == ("lidar",)
    assert at(m, 12.0, lidar=12.0, gps=12.0).lost == ("lidar",)
    assert at(m, 41.0, lidar=41.0, gps=41.0) == Health()


def test_what_it_must_not_drive_without():
    m = HealthMonitor(P, ("left", "right", "gps"), (), ("left", "right"))
    at(m, 0.0, left=0.0, right=0.0, gps=0.0)
    assert at(m, 5.0, left=0.0, right=5.0, gps=5.0).unfit == ""
    assert at(m, 9.0, left=0.0, right=5.0, gps=9.0).unfit == "all scanners"
    assert at(m, 99.0, left=99.0, right=99.0, gps=9.0).unfit == "gps"


def test_what_was_never_fitted_is_not_missed():
    m = HealthMonitor(P, ("left", "gps"), (), ("left",))
    at(m, 0.0)
    assert at(m, 5.0).unfit == ""
