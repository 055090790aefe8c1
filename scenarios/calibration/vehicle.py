"""The Ranger with other parameters than its model's, on a level plane."""

from dataclasses import replace
from typing import NamedTuple

import mujoco

import models
from scenarios.calibration.quantities import QUANTITIES, Values
from twin.drivetrain import DrivetrainParameters
from twin.vehicle import WHEELS

START = (0.0, 0.0, 0.0, 0.0)


class Settings(NamedTuple):
    """What makes a plant: a model, and what its drivetrain and steering are told."""

    model: mujoco.MjModel
    drivetrain: DrivetrainParameters
    steering_gain: float


def settings(values: Values) -> Settings:
    """The vehicle of some values; it stands where the model's stands, with its own load."""
    v = {name: quantity.model for name, quantity in QUANTITIES.items()} | dict(values)
    spec = mujoco.MjSpec.from_file(models.path())
    _load(spec, v["mass"], v["cg_height"])
    _spring(spec, v["springs"])
    spec.worldbody.add_geom(
        name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1],
        friction=[v["friction"], 0.005, 0.0001],
    )  # fmt: skip
    own = DrivetrainParameters()
    brakes = tuple(v["brakes"] * torque for torque in own.brake_n_m)
    drivetrain = replace(own, rolling_n_m=v["rolling"], brake_n_m=brakes)
    return Settings(spec.compile(), drivetrain, v["steering"])


def _load(spec: mujoco.MjSpec, mass_kg: float, height_m: float) -> None:
    """Give the sprung body what is not in the wheels; its radii of gyration stay."""
    wheels = [spec.body(f"{wheel}_wheel") for wheel in WHEELS]
    unsprung_kg = float(sum(w.mass for w in wheels))
    moment = float(sum(w.mass * w.pos[2] for w in wheels))
    body = spec.body("ranger")
    sprung_kg = mass_kg - unsprung_kg
    body.inertia = body.inertia * (sprung_kg / body.mass)
    body.ipos = [*body.ipos[:2], (mass_kg * height_m - moment) / sprung_kg]
    body.mass = sprung_kg


def _spring(spec: mujoco.MjSpec, times: float) -> None:
    """Stiffer or softer springs that carry the same load at the same height."""
    for wheel in WHEELS:
        joint = spec.joint(f"{wheel}_suspension")
        joint.stiffness = joint.stiffness * times
        joint.springref = joint.springref / times
