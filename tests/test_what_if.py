"""The rest of a drive: the same to the bit with the same terms, another one with others."""

import pytest

from nav.parameters import parameters_from
from scenarios.episode import Episode
from scenarios.parameter_files import parameter_texts, parameters_of
from scenarios.random_field.course import build
from scenarios.what_if import Snapshots, rest

SEED, AT_S = 3, 12.34


@pytest.fixture(scope="module")
def snapshots():
    return Snapshots(lambda: Episode(build(SEED), SEED))


@pytest.fixture(scope="module")
def original():
    episode = Episode(build(SEED), SEED)
    while episode.outcome is None:
        episode.tick()
    return episode


def tuned():
    """One that is never in a hurry."""
    texts = parameter_texts("dubins")
    old, new = "ML = 6.5, L = 11.2", "ML = 4.5, L = 5.0"
    assert old in texts["speed.toml"]
    texts["speed.toml"] = texts["speed.toml"].replace(old, new)
    return parameters_from(texts, "dubins")


def test_with_the_same_terms_the_rest_is_what_it_was(snapshots, original):
    p = parameters_of("dubins")
    for _ in range(2):  # from the start, then from a snapshot
        episode = snapshots.at(AT_S)
        assert episode.time_s == pytest.approx(AT_S, abs=0.02)
        last = list(rest(episode, p.steering, p.speed))[-1]
        assert last.outcome == original.outcome == "finished"
        assert episode.digest.hex() == original.digest.hex()


def test_the_second_time_it_goes_on_from_a_snapshot(snapshots):
    snapshots.at(AT_S)
    passed = []
    snapshots.at(AT_S, passed.append)
    assert 10.0 < min(passed) < max(passed) == pytest.approx(AT_S, abs=0.02)


def test_with_other_terms_it_is_another_drive(snapshots, original):
    p = tuned()
    episode = snapshots.at(AT_S)
    reports = list(rest(episode, p.steering, p.speed))
    assert reports[0].time_s == pytest.approx(AT_S, abs=0.02)
    assert [r.outcome is None for r in reports] == [True] * (len(reports) - 1) + [False]
    assert episode.digest.hex() != original.digest.hex()
