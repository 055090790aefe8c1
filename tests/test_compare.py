"""`ion compare`: variants are one drive until they are varied."""

import json

import pytest
from test_cli import refused

from ion.__main__ import main
from ion.compare.variants import Drive, Look, parted_s, probability
from ion.courses import scenario_source
from scenarios.episode import Episode
from scenarios.parameter_files import parameters_of
from scenarios.variation import Vary, apply, names, parse, shifting_in, variants

P = parameters_of("ion")


def drive(*bits):
    return Drive(0, 0, "finished", 1.0, 2, 0.0, [Look(k, k, b) for k, b in enumerate(bits)])


def test_every_combination():
    varies = [Vary("a", (1, 2)), Vary("b", (3, 4))]
    assert variants(varies) == [
        {"a": 1, "b": 3}, {"a": 1, "b": 4}, {"a": 2, "b": 3}, {"a": 2, "b": 4},
    ]  # fmt: skip


def test_values_are_of_the_kind_of_their_name():
    assert parse("stuck.tries=1, 6", P) == Vary("stuck.tries", (1, 6))
    assert parse("drivetrain.shift_s=1,60", P).values == (1.0, 60.0)
    assert parse("watchdog.counts_shift_time=true", P).values == (True,)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("stuck.tries", "expected NAME=VALUE"),
        ("gears=3", "cannot be varied; there are: judge.patience_s"),
        ("stuck.tries=1.5", "expected a whole number"),
        ("judge.patience_s=-1", "expected 0 or more"),
        ("judge.patience_s=nan", "expected 0 or more"),
        ("watchdog.override=none", "expected paper or guarded"),
        ("watchdog.counts_shift_time=yes", "expected true or false"),
    ],
)
def test_what_is_wrong_is_said(text, said):
    with pytest.raises(ValueError, match=said):
        parse(text, P)


def test_all_that_can_be_varied_reaches_the_drive():
    episode = Episode(scenario_source("tunnel").course(0), 0)
    for name, value in names(P).items():
        apply(episode, {name: "paper" if name == "watchdog.override" else value})
    assert episode.judge.patience.seconds == 0.0
    assert episode.navigator.parameters.states.watchdog.override == "paper"
    machine = episode.navigator.high_level.machine
    assert machine.parameters.states.watchdog.override == "paper"


def test_a_shift_takes_as_long_as_it_is_told():
    box = shifting_in(60.0)
    assert box.shift_s_per_position == box.shift_least_s == box.shift_limit_s == 20.0
    assert box.try_again == box.shift_sigma == 0.0


def test_where_drives_part():
    assert parted_s(drive("a", "b", "c"), drive("a", "b", "c")) is None
    assert parted_s(drive("a", "b", "c"), drive("a", "x", "y")) == 1
    assert parted_s(drive("a", "b", "c"), drive("a", "b")) == 1


def test_the_interval_of_wilson():
    share, low, high = probability(9, 10)
    assert (share, low, high) == pytest.approx((0.9, 0.5958, 0.9821), abs=1e-4)
    assert probability(0, 5)[1] == 0.0


def test_variants_are_the_same_until_then(monkeypatch, capsys, tmp_path):
    out = tmp_path / "c.png"
    words = ["compare", "tunnel", "--vary", "tunnel.speed_mps=2.2,1.2", "--at", "20", "--json"]
    monkeypatch.setattr("sys.argv", ["ion", *words, "--out", str(out)])
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 0
    usual, slow = (json.loads(line) for line in capsys.readouterr().out.splitlines())
    assert usual["parted_s"] is None
    assert slow["parted_s"] > 20.0
    assert slow["time_s"] > usual["time_s"] + 3.0
    assert usual["outcomes"] == slow["outcomes"] == {"finished": 1}
    assert out.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["tunnel"], "expected at least one"),
        (["tunnel", "--vary", "x=1"], "cannot be varied"),
        (["moon", "--vary", "stuck.tries=1"], "there are: dead_end"),
        (["random_field", "--vary", "stuck.tries=1"], "expected ION's"),
        (["tunnel", "--vary", "stuck.tries=1", "--at", "-3"], "expected seconds"),
        (["tunnel", "--vary", "stuck.tries=1", "--seeds", "b"], "0-19"),
    ],
)
def test_wrong_arguments_are_one_line(words, said, monkeypatch, capsys):
    assert said in refused(monkeypatch, capsys, "compare", *words)
