"""Points changed in the texts of parameter files: only they, for every term and vehicle."""

import pytest

from ion.view.tune.terms import OUTPUT, Place, places, points_of, range_of, turned
from nav.errors import NavError
from nav.parameters import parameters_from
from scenarios.parameter_files import parameter_texts, parameters_of
from scenarios.vehicles import VEHICLES


def every_term():
    for vehicle in VEHICLES:
        for place in places(parameters_of(vehicle)):
            for term in points_of(parameters_of(vehicle), place):
                yield vehicle, place, term


@pytest.mark.parametrize(("vehicle", "place", "term"), list(every_term()), ids=str)
def test_only_the_numbers_of_that_term_change(vehicle, place, term):
    texts, p = parameter_texts(vehicle), parameters_of(vehicle)
    points = tuple(round(point + 1e-5, 6) for point in points_of(p, place)[term])
    changed = turned(texts, vehicle, place, term, points)
    lines = [
        pair
        for name in texts
        for pair in zip(texts[name].splitlines(), changed[name].splitlines(), strict=True)
        if pair[0] != pair[1]
    ]
    assert len(lines) == 1
    try:
        now = parameters_from(changed, vehicle)
    except NavError:
        return  # STOP must be 0, for one
    assert points_of(now, place) == points_of(p, place) | {term: points}


def test_comments_stay():
    place = Place("steering", "select", "offset_rad")
    texts = turned(parameter_texts(), "ion", place, "S", (0.2, 0.3))
    assert "# crossing at 12 and 29 degrees" in texts["steering.toml"]
    assert 'S = { shape = "left_shoulder", points = [0.2, 0.3] }' in texts["steering.toml"]


def test_a_range_holds_its_points():
    p = parameters_of()
    for place in places(p):
        low, high = range_of(p, place)
        for points in points_of(p, place).values():
            assert low <= points[0] <= points[-1] <= high, place
    assert any(place.variable == OUTPUT for place in places(p))
