"""The paper's point-mass simulator: (6.9), (6.10), reverse, what is heard, and what is contact."""

import tomllib
from dataclasses import fields
from importlib.resources import files
from math import atan2, cos, pi, sin

import numpy as np
import pytest

from nav.messages import (
    ActuatorTargets,
    CompassHeading,
    Floats,
    Gear,
    GpsFix,
    LidarScan,
    VehicleState,
)
from nav.parameters import parameters_from
from scenarios.ablation import disabled_sensors
from scenarios.parameter_files import parameter_texts
from scenarios.random_field.course import ANCHOR_DEG, Plain
from scenarios.vehicles import VEHICLES
from twin.dubins import DubinsSimulator, circles_of, dubins_parameters
from twin.dubins.circles import ranges_m, touched
from twin.dubins.drive import IdealDrive
from twin.dubins.kinematics import State, advance, limited
from twin.world import Obstacle, World

P = dubins_parameters()
R = P.drive.minimum_radius_m
LOCK = P.drive.steering_limit_rad


def circle(x, y, radius, name="circle"):
    return Obstacle(name, "circle", "cylinder", (x, y, 1.0), (radius, radius, 1.0))


def simulator(*circles, seed=0, disabled=frozenset()):
    world = World(Plain(), tuple(circles), 1.0, ANCHOR_DEG, (0.0, 0.0, 0.0))
    return DubinsSimulator(world, seed, disabled)


def targets(steering=0.0, throttle=0.0, brake=0.0, gear=Gear.HIGH):
    return ActuatorTargets(0, steering, throttle, brake, gear)


def driven(sim, ticks, **wanted):
    """The states after each tick, and all messages."""
    heard, states = [], []
    for _ in range(ticks):
        heard += sim.advance(targets(**wanted))
        states.append(sim.state)
    return states, heard


# ---------------------------------------------------------------------- (6.9)


def test_a_straight_line_is_u_t_plus_half_a_t_squared():
    end = advance(State(1.0, 2.0, pi / 2.0, 3.0), 2.0, 0.0, 0.5)
    assert end == pytest.approx((1.0, 2.0 + 3.0 * 0.5 + 0.25, pi / 2.0, 4.0))


def test_constant_omega_drives_a_circle_in_any_number_of_steps():
    state, u = State(0.0, 0.0, 0.0, 5.0), 5.0
    for _ in range(300):
        state = advance(state, 0.0, 1.0 / R, 0.01)
    turned = u * 3.0 / R
    assert state == pytest.approx((R * sin(turned), R * (1.0 - cos(turned)), turned, u))


def test_it_agrees_with_small_euler_steps_of_the_equations():
    end, a, k, dt = advance(State(0.0, 0.0, 0.3, 2.0), 1.5, -0.1, 1.0), 1.5, -0.1, 1e-5
    x = y = 0.0
    theta, u = 0.3, 2.0
    for _ in range(100_000):
        x, y, theta, u = (
            x + u * cos(theta) * dt,
            y + u * sin(theta) * dt,
            theta + k * u * dt,
            (u + a * dt),
        )
    assert end == pytest.approx((x, y, theta, u), abs=1e-4)


def test_backwards_along_an_arc_leads_back():
    there = advance(State(0.0, 0.0, 0.4, 3.0), 0.0, 1.0 / R, 1.0)
    back = advance(there._replace(speed_mps=-3.0), 0.0, 1.0 / R, 1.0)
    assert back[:3] == pytest.approx((0.0, 0.0, 0.4))


# ---------------------------------------------------------------------- (6.10) and the drive


@pytest.mark.parametrize("steering", [-9.0, -LOCK, -0.1, 0.0, 0.2, LOCK, 9.0])
@pytest.mark.parametrize("speed", [-4.0, 0.0, 2.0, 8.0])
def test_omega_over_u_never_exceeds_one_over_r(steering, speed):
    drive = IdealDrive(P.drive)
    drive.apply(0, targets(steering, throttle=1.0))
    before = State(0.0, 0.0, 0.0, speed)
    after = drive.step(0, before, 0.02)
    way = 0.02 * 0.5 * (before.speed_mps + after.speed_mps)
    assert abs(after.heading_rad) <= abs(way) / R + 1e-12


def test_the_limit_is_that_of_the_paper():
    assert limited(1.0, R) == 1.0 / R
    assert limited(-1.0, R) == -1.0 / R
    assert limited(0.05, R) == 0.05


def test_full_lock_drives_the_smallest_circle():
    sim = simulator()
    states, _ = driven(sim, 1500, steering=LOCK, throttle=0.1)
    xy = np.array([s[:2] for s in states])
    assert np.hypot(xy[:, 0], xy[:, 1] - R) == pytest.approx(R, abs=1e-9)


def test_the_brake_stops_and_holds_and_wins_over_the_throttle():
    drive, state = IdealDrive(P.drive), State(0.0, 0.0, 0.0, 1.0)
    drive.apply(0, targets(throttle=1.0, brake=1.0))
    for _ in range(20):
        state = drive.step(0, state, 0.02)
    assert state.speed_mps == 0.0
    assert state.x_m == pytest.approx(1.0 / (2.0 * P.drive.brake_mps2))


def test_it_reverses_after_a_shift_and_not_before():
    sim = simulator()
    states, heard = driven(sim, 60, throttle=0.5, gear=Gear.REVERSE)
    moving = [k for k, s in enumerate(states) if s.speed_mps != 0.0]
    assert moving[0] == round(P.drive.shift_s / 0.02)
    assert states[-1].speed_mps < 0.0
    assert states[-1].x_m < 0.0
    shifting = [m.shifting for m in heard if isinstance(m, VehicleState)]
    assert shifting[0]
    assert not shifting[-1]
    last = [m for m in heard if isinstance(m, VehicleState)][-1]
    assert last.gear is Gear.REVERSE
    assert last.wheel_speed_mps.min() > 0.0  # counters know no sign


def test_reverse_turns_the_other_way_round():
    sim = simulator()
    states, _ = driven(sim, 100, steering=LOCK, throttle=0.5, gear=Gear.REVERSE)
    assert states[-1].heading_rad < 0.0
    assert states[-1].y_m > 0.0  # on the circle to the left


def test_without_targets_it_stops():
    drive, state = IdealDrive(P.drive), State(0.0, 0.0, 0.0, 2.0)
    drive.apply(0, targets(throttle=1.0))
    late = round(P.drive.timeout_s * 1e9)
    assert drive.step(late - 1, state, 0.02).speed_mps > 2.0
    assert drive.step(late, state, 0.02).speed_mps < 2.0


@pytest.mark.parametrize("bad", [float("nan"), float("inf")])
def test_targets_that_are_no_numbers_count_as_not_arrived(bad):
    drive = IdealDrive(P.drive)
    drive.apply(0, targets(0.1, 0.2))
    drive.apply(20, targets(bad, 0.2))
    assert drive.applied.steering_rad == 0.1


# ---------------------------------------------------------------------- scans


def fan(*circles, pose=(0.0, 0.0, 0.0), beams=361, limit=40.0):
    step = pi / (beams - 1)
    return ranges_m(circles_of(circles), pose, -pi / 2.0, step, beams, limit)


def brute_force(circles, pose, beams, limit):
    """Each beam against each circle by the quadratic formula."""
    found = np.full(beams, limit)
    for k, angle in enumerate(np.linspace(-pi / 2.0, pi / 2.0, beams) + pose[2]):
        for x, y, r in circles:
            dx, dy = x - pose[0], y - pose[1]
            along, across = cos(angle) * dx + sin(angle) * dy, cos(angle) * dy - sin(angle) * dx
            if along > 0.0 and abs(across) < r:
                found[k] = min(found[k], along - np.sqrt(r * r - across * across))
    return found


@pytest.mark.parametrize("heading", [0.0, 1.0, pi, -3.0, 7.5, 40.0])
def test_ranges_are_those_of_a_beam_by_beam_search(heading):
    rng = np.random.default_rng(3)
    circles = np.column_stack([rng.uniform(-50, 50, (60, 2)), rng.uniform(0.5, 4.0, 60)])
    circles = circles[np.hypot(circles[:, 0], circles[:, 1]) > circles[:, 2] + 0.5]
    pose = (0.0, 0.0, heading)
    step = pi / 360
    found = ranges_m(circles, pose, -pi / 2.0, step, 361, 40.0)
    np.testing.assert_allclose(found, brute_force(circles, pose, 361, 40.0), atol=1e-6)


def test_what_stands_behind_a_circle_is_not_seen():
    near, hidden, beside = circle(10, 0, 2), circle(20, 0, 2), circle(20, 10, 2)
    np.testing.assert_array_equal(fan(near, hidden, beside), fan(near, beside))
    assert fan(near, beside).min() == pytest.approx(8.0)


def test_nothing_is_seen_beyond_the_range_or_behind():
    assert (fan(circle(45, 0, 2), circle(-10, 0, 2)) == 40.0).all()


def scans(sim, ticks=5):
    return [m for m in driven(sim, ticks)[1] if isinstance(m, LidarScan)]


def test_scans_have_noise_and_are_whole_counts():
    error = np.concatenate([
        s.range_m[178:183] - 8.0
        for seed in range(80)
        for s in scans(simulator(circle(10, 0, 2), seed=seed))
    ])  # fmt: skip
    expected = np.hypot(P.scan.noise_sd_m, P.scan.bias_sd_m)
    assert np.std(error) == pytest.approx(expected, rel=0.25)
    assert abs(np.mean(error)) < 0.02
    np.testing.assert_allclose(error * 100.0, np.rint(error * 100.0), atol=1e-6)


def test_a_beam_that_meets_nothing_says_so():
    scan = scans(simulator(circle(10, 0, 2)))[0]
    assert scan.range_m[0] == 81.92
    assert scan.sensor == "lidar_field"
    assert len(scan.range_m) == P.scan.beams


# ---------------------------------------------------------------------- other sensors


def test_the_noise_of_one_sensor_does_not_depend_on_the_others():
    _, all_heard = driven(simulator(circle(10, 0, 2)), 50, throttle=0.3)
    silent = frozenset({"gps", "lidar_field"})
    _, few_heard = driven(simulator(circle(10, 0, 2), disabled=silent), 50, throttle=0.3)
    kinds = (CompassHeading, VehicleState)
    kept = [m for m in all_heard if isinstance(m, kinds)]
    assert {type(m) for m in few_heard} == set(kinds)
    for one, other in zip(kept, few_heard, strict=True):
        assert repr(one) == repr(other)


def test_every_measured_number_differs_between_two_seeds():
    one, other = (
        driven(simulator(circle(10, 0, 2), seed=seed), 100, throttle=0.3)[1] for seed in (1, 2)
    )
    for a, b in zip(one, other, strict=True):
        for f in fields(a):
            if f.type is float:
                assert getattr(a, f.name) != getattr(b, f.name), f.name
            elif f.type is Floats and not isinstance(a, LidarScan):
                assert (getattr(a, f.name) != getattr(b, f.name)).all(), f.name


def test_a_fix_is_near_the_truth_but_never_on_it():
    errors = []
    for seed in range(40):
        for m in driven(simulator(seed=seed), 10)[1]:
            if isinstance(m, GpsFix):
                errors.append((m.latitude_deg - ANCHOR_DEG[0]) * 111_000.0)
    assert np.std(errors) == pytest.approx(0.1, rel=0.4)
    assert np.min(np.abs(errors)) > 0.0


def test_the_compass_counts_from_east_within_half_a_turn():
    sim = simulator()
    sim.state = sim.state._replace(heading_rad=3.0 * pi)
    heading = next(m for m in driven(sim, 10)[1] if isinstance(m, CompassHeading)).heading_rad
    assert -pi < heading <= pi
    assert abs(atan2(sin(heading - pi), cos(heading - pi))) < 0.1


@pytest.mark.parametrize("ablation", ["blind", "no-lidar", "no-gps", "no-compass", "no-odometry"])
def test_ablations_silence_what_the_point_has(ablation):
    silent = disabled_sensors((ablation,), VEHICLES["dubins"].lidars, ())
    gone = {type(m) for m in driven(simulator(), 10)[1]}
    gone -= {type(m) for m in driven(simulator(disabled=silent), 10)[1]}
    names = {"no-gps": GpsFix, "no-compass": CompassHeading, "no-odometry": VehicleState}
    assert gone == {names.get(ablation, LidarScan)}


# ---------------------------------------------------------------------- contact


def test_contact_is_a_centre_distance_below_radius_and_disc():
    circles = circles_of([circle(10.0, 0.0, 2.0)])
    reach = 2.0 + P.drive.disc_radius_m
    assert touched(circles, 10.0 - reach + 1e-6, 0.0, P.drive.disc_radius_m).tolist() == [0]
    assert not touched(circles, 10.0 - reach - 1e-6, 0.0, P.drive.disc_radius_m).size


def test_the_truth_names_what_is_touched():
    sim = simulator(circle(5.0, 0.0, 1.0, "near"), circle(30.0, 0.0, 1.0, "far"))
    while not sim.truth().contacts:
        sim.advance(targets(throttle=1.0))
    assert sim.truth().contacts == ("near",)
    gap = 5.0 - sim.state.x_m - 1.0
    assert P.drive.disc_radius_m - 0.1 < gap < P.drive.disc_radius_m


def test_the_judge_measures_from_the_same_disc():
    outline = VEHICLES["dubins"].outline
    assert outline == (0.0, 0.0, 0.0, P.drive.disc_radius_m)
    border = np.array(outline.border_m((1.0, 2.0, 0.5)))
    assert np.hypot(*(border - (1.0, 2.0)).T) == pytest.approx(P.drive.disc_radius_m)


def test_boxes_are_refused():
    with pytest.raises(ValueError, match="cylinder"):
        circles_of([Obstacle("crate", "box", "box", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))])


# ---------------------------------------------------------------------- the navigator's file


def test_the_navigators_file_agrees_with_the_plant():
    vehicle = parameters_from(parameter_texts("dubins"), "dubins").vehicle
    steering, lidar = vehicle.steering, vehicle.lidar
    assert steering.limit_rad == LOCK
    assert steering.linear_m == steering.minimum_radius_m == R
    assert (steering.quadratic_m2, steering.delay_s) == (0.0, 0.0)
    assert list(vehicle.lidar_mounts) == ["lidar_field"]
    assert lidar.count == P.scan.beams
    assert lidar.first_rad == -P.scan.half_fan_rad
    assert lidar.step_rad == pytest.approx(2.0 * P.scan.half_fan_rad / (P.scan.beams - 1))
    assert lidar.max_range_m == P.scan.max_range_m
    corner = np.hypot(vehicle.outline.front_m, vehicle.outline.half_width_m)
    assert corner < P.drive.disc_radius_m  # what may stand beside the disc is never cleared away


def test_its_file_says_only_what_differs_from_ion():
    said = tomllib.loads(parameter_texts("dubins")["dubins.toml"])
    for table, values in said.items():
        ion = tomllib.loads((files("nav.parameters") / f"{table}.toml").read_text())
        assert not [path for path in _leaves(values) if _at(ion, path) == _at(values, path)]


def _leaves(table, path=()):
    """What is replaced: single values, and the inputs of a rule base as a whole."""
    for key, value in table.items():
        deeper = isinstance(value, dict) and key != "inputs"
        yield from _leaves(value, (*path, key)) if deeper else [(*path, key)]


def _at(table, path):
    for key in path:
        table = table.get(key, {}) if isinstance(table, dict) else {}
    return table
