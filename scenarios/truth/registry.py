"""All checks, by the names that `ion truth` takes."""

from collections.abc import Callable

from scenarios.truth import (
    actuation,
    circle,
    handling,
    rollover,
    sensors,
    straight,
    tunnel_exit,
)
from scenarios.truth.check import Check

CHECKS: dict[str, Callable[[], Check]] = {
    function.__name__: function
    for function in (
        circle.turning_circle,
        circle.middle_axle,
        handling.steady_state_circle,
        handling.step_steer,
        handling.lane_change,
        straight.acceleration,
        straight.top_speed,
        straight.power,
        straight.braking,
        straight.coast_down,
        straight.climbing,
        straight.holding,
        straight.rumble_strips,
        rollover.static_rollover,
        actuation.lock_to_lock,
        actuation.steering_delay,
        straight.throttle_delay,
        actuation.shifts,
        actuation.lost_commands,
        sensors.lidar_noise,
        sensors.gps_cep,
        sensors.tunnel_sky,
        tunnel_exit.after_the_tunnel,
        sensors.gyro_noise,
        sensors.gyro_walk,
    )
}
"""In the order of the page."""
