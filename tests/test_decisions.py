"""Decisions found again by replay, and what other terms make of them."""

from pathlib import Path

import pytest

from ion.explain.asked import decision_at
from ion.view.decide.decisions import Decisions
from ion.view.decide.words import told
from ion.view.tune.terms import Place
from ion.view.tune.tuning import Tuning
from scenarios.parameter_files import parameter_texts

AT_S = 15.4
CAREFUL = (Place("speed", "anti_collision", "D1_m"), "L", (20.0, 39.0))


@pytest.fixture(scope="module")
def decisions(short_tape):
    decisions = Decisions(Path(short_tape))
    while decisions.advance(1000):
        pass
    return decisions


@pytest.fixture
def tuning():
    return Tuning(parameter_texts(), "ion")


def test_any_moment_is_found_as_ion_explain_finds_it(decisions, short_tape):
    for at_s in (AT_S, 5.0, AT_S):
        found = decisions.at(at_s, {})
        why = decision_at(Path(short_tape), at_s, lambda _: None).explanation
        assert (found.was["time_s"], found.was["state"]) == (why.time_s, why.state)
        assert found.was["speed_mps"] == why.plan.speed_mps
        assert found.same
        assert found.would is None


def test_before_the_first_decision_there_is_none(decisions):
    assert decisions.at(0.1, {}) is None


def test_other_terms_make_another_decision(decisions, tuning):
    place, term, points = CAREFUL
    tuning.turn(Place("speed", "anti_collision", "D1_m"), "M", (7.0, 20.0, 39.0))
    tuning.turn(place, term, points)
    found = decisions.at(AT_S, dict(tuning.changed()))
    assert found.would["distance_real_m"] == found.was["distance_real_m"]  # the same world
    assert found.would["speed_rules"] != found.was["speed_rules"]
    assert "**Tuned:**" in told(found)


def test_what_cannot_be_is_refused_and_nothing_is_lost(tuning):
    place, term, points = CAREFUL
    tuning.turn(place, term, points)
    before = tuning.files()
    tuning.turn(place, term, (39.0, 20.0))
    assert "must increase strictly" in tuning.refused
    assert tuning.files() == before
    tuning.reset()
    assert (tuning.refused, tuning.diff()) == ("", "")


def test_only_changed_files_are_saved_and_replay_takes_them(tuning, tmp_path):
    from ion.replay.options import texts_of

    tuning.turn(*CAREFUL)
    assert "+L = { shape" in tuning.diff()
    assert [path.name for path in tuning.save(tmp_path / "new")] == ["speed.toml"]
    assert "points = [20.0, 39.0]" in texts_of(tmp_path / "new", "ion")["speed.toml"]
