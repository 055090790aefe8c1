import pytest

from twin import clock


def test_time_does_not_drift():
    assert clock.time_ns(300) == 10**9
    assert clock.time_ns(300 * 3600) == 3600 * 10**9
    assert clock.time_ns(1) == 3333333


@pytest.mark.parametrize(
    ("rate_hz", "steps"), [(37.5, 8), (100.0, 3), (50, 6), (20.0, 15), (10.0, 30), (300.0, 1)]
)
def test_interval_of_the_devices(rate_hz, steps):
    assert clock.interval(rate_hz) == steps


@pytest.mark.parametrize(
    ("rate_hz", "neighbours"),
    [(40.0, "37.5 Hz or 42.8571 Hz"), (70.0, "60 Hz or 75 Hz"), (1000.0, "300 Hz would")],
)
def test_a_rate_that_does_not_divide_is_refused(rate_hz, neighbours):
    with pytest.raises(ValueError, match=neighbours):
        clock.interval(rate_hz)


@pytest.mark.parametrize("rate_hz", [0.0, -1.0, float("nan"), float("inf")])
def test_a_rate_that_is_no_rate_is_refused(rate_hz):
    with pytest.raises(ValueError, match="expected a positive number"):
        clock.interval(rate_hz)
