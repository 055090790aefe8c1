"""Along a straight line: accelerating, braking, coasting, climbing, and bumps."""

import numpy as np

from nav.messages import Gear
from scenarios.truth.check import Check, Curve, Range, within
from scenarios.truth.rig import TICK_S, Rig, plane
from twin.drivetrain import DrivetrainParameters

MPH_25, MPH_40 = 11.18, 17.88
CRANK_W, EFFICIENCY = 22_400.0, 0.76
SLOPES_DEG = np.array([10.0, 15.0, 20.0, 25.0, 30.0, 35.0])


def top_speed() -> Check:
    """In High, full throttle."""
    rig = Rig().drive(40.0, throttle=1.0)
    time_s, speed = rig.of("time_s"), rig.of("speed_mps")
    return Check(
        title="Top speed in High", unit="m/s", twin=float(speed[-50:].mean()),
        grade="published", source='"about 40 mph", commonly said, unverified',
        curve=Curve(time_s, "time [s]", "speed [m/s]", {"twin": speed}),
        allowed=within(MPH_40, 0.1),
    )  # fmt: skip


def acceleration() -> Check:
    """From a stand to 25 mph."""
    rig = Rig().until(lambda m: m.speed_mps > MPH_25, 30.0, throttle=1.0)
    lines = {"twin": rig.of("speed_mps")}
    return Check(
        title="0 to 25 mph", unit="s", twin=rig.time_s, allowed=Range(5.0, 10.0),
        grade="estimated",
        source="30 hp and 1,040 kg: 3.8 s at the crank's power, and what CVT and ground take",
        curve=Curve(rig.of("time_s"), "time [s]", "speed [m/s]", lines),
    )  # fmt: skip


def power() -> Check:
    """What reaches the wheels, at most, with what CVT and axles take put back."""
    rig = Rig().drive(12.0, throttle=1.0)
    p, speed = DrivetrainParameters(), rig.of("speed_mps")
    mass = float(rig.plant.model.body_mass.sum())
    losses = 6.0 * p.rolling_n_m / 0.3175 + p.drag_n_s2_m2 * speed**2
    watts = (mass * np.gradient(speed, TICK_S) + losses) * speed
    smooth = np.convolve(watts, np.ones(25) / 25.0, "same")
    lines = {"at the wheels / 0.76 [kW]": 1e-3 * smooth / EFFICIENCY}
    return Check(
        title="Engine power, from acceleration and losses", unit="kW",
        twin=1e-3 * float(smooth.max()) / EFFICIENCY, grade="published",
        source="30 hp of the 499 cc Ranger 4x4; 76 % of it at the wheels is estimated",
        curve=Curve(speed, "speed [m/s]", "power [kW]", lines), allowed=within(1e-3 * CRANK_W, 0.1),
    )  # fmt: skip


def throttle_delay() -> Check:
    """From the command to a tenth of the acceleration's effect."""
    rig = Rig().drive(1.0, brake=0.0)
    began = rig.time_s
    rig.until(lambda m: m.speed_mps > 0.1, 5.0, throttle=0.3)
    return Check(
        title="Throttle: from the command to the first 0.1 m/s", unit="s",
        twin=rig.time_s - began, allowed=Range(0.2, 2.0), grade="published",
        source="Overbot: throttle delay up to 2 s",
    )  # fmt: skip


def braking() -> Check:
    """Full brake from 25 mph."""
    rig = Rig().until(lambda m: m.speed_mps > MPH_25, 30.0, throttle=1.0)
    began, start = len(rig.moments), rig.moments[-1]
    rig.until(lambda m: m.speed_mps < 0.05, 10.0, brake=1.0)
    speed, time_s = rig.of("speed_mps")[began:], rig.of("time_s")[began:] - start.time_s
    fast = (speed < 10.0) & (speed > 2.0)
    slowed = -float(np.polyfit(time_s[fast], speed[fast], 1)[0])
    way = rig.moments[-1].x_m - start.x_m
    return Check(
        title="Straight-line braking, full brake, 10 to 2 m/s", unit="m/s^2", twin=slowed,
        allowed=Range(4.0, 6.5),
        grade="estimated",
        source="four wheels hydraulically braked (published); dry dirt gives 0.5 to 0.7 g",
        remark=f"From 25 mph it stands after {way:.1f} m, delays included.",
        curve=Curve(time_s, "time since the command [s]", "speed [m/s]", {"twin": speed}),
    )  # fmt: skip


def coast_down() -> Check:
    """In Neutral from 12 m/s: rolling resistance and drag, found again by a fit."""
    rig = Rig(gear=Gear.NEUTRAL).push(12.0).drive(22.0)
    mass, p = float(rig.plant.model.body_mass.sum()), DrivetrainParameters()
    time_s, speed = rig.of("time_s")[50:], rig.of("speed_mps")[50:]
    slowed = -np.gradient(np.convolve(speed, np.ones(25) / 25.0, "valid"), TICK_S)
    middle = speed[12:-12]
    A = np.column_stack([np.ones_like(middle), middle**2])
    rolling, drag = np.linalg.lstsq(A, slowed, rcond=None)[0]
    spin = 1.0 + 6.0 * (1.1 + 0.6) / 0.3175**2 / mass
    given = 6.0 * p.rolling_n_m / 0.3175 / (mass * 9.81)
    found = float(rolling) * spin / 9.81
    return Check(
        title="Coast-down in Neutral: rolling resistance", unit="", twin=found,
        grade="estimated", source="16 N m a wheel, 10 psi tires on dirt",
        remark=f"Drag found: {float(drag) * spin * mass:.2f} of {p.drag_n_s2_m2:.2f} N s^2/m^2.",
        curve=Curve(time_s, "time [s]", "speed [m/s]", {"twin": speed}),
        allowed=within(given, 0.15),
    )  # fmt: skip


def climbing() -> Check:
    """The steepest slope on which it still gains speed in Low, from a stand."""
    gained = np.array([_climbed(float(slope)) for slope in SLOPES_DEG])
    able = SLOPES_DEG[gained > 0.5]
    return Check(
        title="Hill climbing in Low, from a stand", unit="deg",
        twin=float(able.max()) if len(able) else 0.0, allowed=Range(20.0, 35.0),
        grade="estimated",
        source="utility vehicles of six driven wheels climb 25 to 30 degrees",
        curve=Curve(SLOPES_DEG, "slope [deg]", "m/s after 5 s", {"twin": gained}, points=True),
    )  # fmt: skip


def _climbed(slope_deg: float) -> float:
    rig = Rig(plane(pitch_rad=np.radians(slope_deg)), gear=Gear.LOW).drive(1.0, brake=1.0)
    return float(rig.drive(5.0, throttle=1.0).moments[-1].speed_mps)


def holding() -> Check:
    """Creep with the brake on, on the slope that the manual allows."""
    rig = Rig(plane(pitch_rad=np.radians(15.0))).drive(3.0, brake=1.0)
    start = rig.moments[-1].x_m
    rig.drive(5.0, brake=1.0)
    return Check(
        title="Hill holding on 15 degrees, brake on: creep", unit="mm/s",
        twin=1e3 * abs(rig.moments[-1].x_m - start) / 5.0, allowed=Range(0.0, 3.0),
        grade="estimated",
        source="a parked vehicle does not creep; the contact's softness does",
    )  # fmt: skip


STRIPS = tuple((12.0 + 0.6 * k, 0.1, 0.05) for k in range(8))
"""Rumble strips: 5 cm high, 0.2 m wide, 0.6 m apart."""


def rumble_strips() -> Check:
    """RMS of the vertical acceleration over rumble strips at 5 m/s."""
    rig = Rig(plane(strips=STRIPS))
    rig.cruise(6.0, 5.0)
    over = (rig.of("x_m") > 10.0) & (rig.of("x_m") < 18.0)
    up, time_s = rig.of("up_mps2")[over] - 9.81, rig.of("time_s")[over]
    return Check(
        title="Ride over rumble strips of 5 cm at 5 m/s: RMS of the vertical acceleration",
        unit="m/s^2", twin=float(np.sqrt(np.mean(up**2))), allowed=Range(0.5, 8.0),
        grade="estimated",
        source="no measurement was found; above 10 m/s^2 wheels leave the ground for long",
        curve=Curve(time_s, "time [s]", "vertical acceleration [m/s^2]", {"twin": up}),
    )  # fmt: skip
