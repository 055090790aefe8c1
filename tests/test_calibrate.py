"""`ion calibrate`: the parameters that made a tape are found on it."""

import json
from functools import partial
from itertools import pairwise

import numpy as np
import pytest

from ion.calibrate import command
from ion.calibrate.options import Options, names_of, truth_of
from ion.errors import UsageError
from nav.messages import VehicleState
from scenarios.calibration import quantities
from scenarios.calibration.evidence import Series, evidence
from scenarios.calibration.fit import fit
from scenarios.calibration.manoeuvre import Phase, manoeuvre, targets
from scenarios.calibration.misfit import means, scatter, vector
from scenarios.calibration.quantities import FITTED, QUANTITIES
from scenarios.calibration.recording import record_manoeuvre
from scenarios.calibration.retrace import retrace
from scenarios.calibration.vehicle import settings
from tape.digest import Digest
from tape.errors import TapeError
from tape.instruments import DriveTorque
from tape.reader import read
from tape.record import record_of_torque
from tape.writer import TapeWriter

SHORT = (
    Phase("stand", 3.0, brake=1.0),
    Phase("pull away", 7.0, throttle=1.0),
    Phase("slalom", 12.0, throttle=0.3, steering_rad=0.1, period_s=2.5),
)
TRUTH = {"mass": 1150.0, "steering": 0.93}


def tape_of(folder, truth=TRUTH, phases=SHORT, seed=1):
    path = folder / "tape.mcap"
    with TapeWriter(path, mode="inputs") as tape:
        record_manoeuvre(tape, seed, truth, phases)
    return path


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    return tape_of(tmp_path_factory.mktemp("calibrate"))


def test_the_manoeuvre_lasts_a_minute_and_begins_at_rest():
    phases = manoeuvre()
    assert phases[0].brake == 1.0
    assert phases[-1].until_s == 60.0
    assert all(a.until_s < b.until_s for a, b in pairwise(phases))


def test_a_slalom_swings_from_its_own_beginning():
    ask = partial(targets, SHORT)
    assert ask(7 * 10**9).steering_rad == pytest.approx(0.0, abs=1e-9)
    assert ask(round((7.0 + 2.5 / 4) * 1e9)).steering_rad == pytest.approx(0.1)
    assert ask(5 * 10**9).throttle == 1.0
    assert ask(99 * 10**9).throttle == 0.3


def test_load_and_springs_are_what_was_asked_for():
    model = settings({"mass": 1200.0, "cg_height": 0.7, "springs": 2.0}).model
    height = model.body_ipos[:, 2] + model.body_pos[:, 2]
    assert model.body_mass.sum() == pytest.approx(1200.0)
    assert (model.body_mass * height).sum() / 1200.0 == pytest.approx(0.7)
    own = settings({}).model
    lift = model.joint("rear_left_suspension").id
    assert model.jnt_stiffness[lift] == 2.0 * own.jnt_stiffness[lift]


def test_the_model_has_the_values_that_the_table_says():
    model = settings({}).model
    height = model.body_ipos[:, 2] + model.body_pos[:, 2]
    assert model.body_mass.sum() == pytest.approx(QUANTITIES["mass"].model)
    moment = (model.body_mass * height).sum()
    assert moment / model.body_mass.sum() == pytest.approx(QUANTITIES["cg_height"].model, abs=1e-4)


def test_the_torque_crosses_the_tape_and_is_not_digested(short):
    everything = list(read(short, "/"))
    torque = [r for r in everything if isinstance(r.message, DriveTorque)]
    assert len(torque) == 1200
    assert max(r.message.torque_n_m for r in torque) == pytest.approx(950.0, rel=0.05)
    assert not any(isinstance(r.message, DriveTorque) for r in read(short))


def test_a_tape_is_a_pure_function_of_seed_and_truth(tmp_path, short):
    def digest(path):
        found = Digest()
        for item in read(path, "/"):
            found.update(item)
        return found.hex()

    assert digest(tape_of(tmp_path)) == digest(short)
    assert digest(tape_of(tmp_path, seed=2)) != digest(short)


def test_scatter_is_the_noise_and_not_the_motion():
    step = np.arange(1, 3001, 3)
    noise = 0.05 * np.random.default_rng(0).standard_normal(len(step))
    value = 3.0 * np.sin(step / 300.0) + noise
    assert scatter(Series(step, value[:, None])).mean() == pytest.approx(0.05, rel=0.05)


def test_the_true_values_explain_a_tape_and_others_do_not(short):
    measured = evidence(short)
    compared = means(measured)
    true, model = (vector(compared, retrace(measured, values)) for values in (TRUTH, {}))
    assert (true**2).mean() < 5.0
    assert (model**2).mean() > 10.0 * (true**2).mean()


def test_finds_what_made_a_short_tape(short):
    pytest.importorskip("tabulate", reason="mujoco[sysid] is not installed")
    found = {f.name: f for f in fit(evidence(short), ("mass", "steering")).found}
    for name, true in TRUTH.items():
        assert found[name].value == pytest.approx(true, rel=0.02), name
        assert found[name].half_width < 0.05 * true
    assert found["mass"].half_width > 0.003 * TRUTH["mass"]  # the torque meter's scale


@pytest.mark.slow
@pytest.mark.parametrize(
    "truth", [{}, {"mass": 1250.0, "friction": 0.55, "steering": 0.9, "cg_height": 0.72}]
)
def test_finds_what_made_the_whole_tape(tmp_path, truth):
    found = {f.name: f.value for f in fit(evidence(tape_of(tmp_path, truth, ())), FITTED).found}
    for name in FITTED:
        true = truth.get(name, QUANTITIES[name].model)
        assert found[name] == pytest.approx(true, rel=0.02), name


@pytest.mark.parametrize(
    ("fitted", "said"), [("mas", "no parameter 'mas'; known are mass,"), (",", "no parameter")]
)
def test_refuses_an_unknown_parameter(fitted, said):
    with pytest.raises(UsageError, match=said):
        names_of(Options("x", fit=fitted))  # type: ignore[arg-type]


@pytest.mark.parametrize("truth", ["mass", "mass=heavy", "mass=nan", "mass=10", "wheels=6"])
def test_refuses_a_truth_that_is_none(truth):
    with pytest.raises(UsageError, match="--truth"):
        truth_of(Options("x", truth=truth))  # type: ignore[arg-type]


def test_refuses_a_tape_without_torque(tmp_path, short):
    other = tmp_path / "other.mcap"
    with TapeWriter(other, mode="inputs") as tape:
        for item in read(short):
            tape.write(item)
    with pytest.raises(TapeError, match="no drive torque on it"):
        evidence(other)


def test_refuses_what_is_no_number(tmp_path, short):
    other = tmp_path / "other.mcap"
    with TapeWriter(other, mode="inputs") as tape:
        for item in read(short, "/"):
            spoilt = isinstance(item.message, DriveTorque) and item.delivery_ns == 5 * 10**9
            broken = record_of_torque(item.delivery_ns, DriveTorque(5 * 10**9, float("nan")))
            tape.write(broken if spoilt else item)
    with pytest.raises(TapeError, match="no number"):
        evidence(other)


def test_refuses_a_tape_that_begins_in_motion(tmp_path, short):
    other = tmp_path / "other.mcap"
    with TapeWriter(other, mode="inputs") as tape:
        for item in read(short, "/"):
            if item.message.time_ns > 6 * 10**9:
                tape.write(item)
    with pytest.raises(TapeError, match="at rest"):
        evidence(other)


def test_says_which_extra_is_missing(short, monkeypatch):
    monkeypatch.setattr(command, "find_spec", lambda name: None)
    with pytest.raises(UsageError, match=r"ion-twin\[calibrate\]"):
        command.calibrate(Options(short, json=True))


def test_the_command_records_and_fits(tmp_path, short, capsys, monkeypatch):
    pytest.importorskip("tabulate", reason="mujoco[sysid] is not installed")
    out = tmp_path / "page.html"
    assert command.calibrate(Options(short, fit="mass", json=True, out=out)) == 0
    said = json.loads(capsys.readouterr().out)
    mass = said["parameters"]["mass"]
    assert mass["low"] < mass["value"] < mass["high"]
    assert set(said["fitted_along"]) == set(quantities.ALONG)
    assert said["misfit"]["after"] < said["misfit"]["before"]
    assert not said["explained"]  # the steering's gain was not asked for
    assert "data:image/png" in out.read_text(encoding="utf-8")


def test_a_recorded_tape_says_what_made_it(tmp_path, monkeypatch):
    monkeypatch.setattr(command, "record_manoeuvre", partial(record_manoeuvre, phases=SHORT))
    log = tmp_path / "new.mcap"
    assert command.calibrate(Options(log, record=True, truth="mass=1100")) == 0
    measured = evidence(log)
    assert measured.made_with["mass"] == 1100.0
    assert measured.made_with["friction"] == QUANTITIES["friction"].model
    assert any(isinstance(r.message, VehicleState) for r in read(log))


def test_refuses_a_tape_on_which_nobody_drives(tmp_path):
    stand = (Phase("stand", 4.0, brake=1.0),)
    with pytest.raises(TapeError, match="hardly moves"):
        evidence(tape_of(tmp_path, phases=stand))


def test_an_interrupted_recording_leaves_what_was_there(tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "record_manoeuvre", interrupted)
    log = tmp_path / "old.mcap"
    log.write_text("before")
    with pytest.raises(KeyboardInterrupt):
        command.calibrate(Options(log, record=True))
    assert [p.name for p in tmp_path.iterdir()] == ["old.mcap"]
    assert log.read_text() == "before"
