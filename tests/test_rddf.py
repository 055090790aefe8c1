from pathlib import Path

import numpy as np
import pytest

from nav.route.rddf import RouteError, parse

GC04 = Path(__file__).parents[2] / "shared" / "data" / "gc04_race_rddf.txt"

GOOD = """1,34.7607233,-117.0107599,90,10,####,####,####
2,34.7607515,-117.0107413,15,10
3,34.7610330,-117.0105600,12,0,####,####,####
"""


def with_line(number, line):
    lines = GOOD.splitlines()
    lines[number - 1] = line
    return "\n".join(lines)


def test_units_become_si():
    route = parse(GOOD, "good.txt")
    assert len(route) == 3
    assert route.number.tolist() == [1, 2, 3]
    np.testing.assert_allclose(route.half_width_m, [27.432, 4.572, 3.6576])
    np.testing.assert_allclose(route.speed_mps, [4.4704, 4.4704, 0.0])


def test_arrays_are_read_only():
    route = parse(GOOD, "good.txt")
    with pytest.raises(ValueError, match="read-only"):
        route.half_width_m[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        route.stretch(1, 2).speed_mps[0] = 1.0


def test_windows_line_ends_and_blank_lines_are_fine():
    assert len(parse(GOOD.replace("\n", "\r\n") + "\r\n\r\n", "good.txt")) == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (with_line(2, "2,34.7607515,-117.0107413,15"), "line 2: .*4 columns, speed limit is mis"),
        (with_line(2, "2,34.76x,-117.0107413,15,10"), "line 2: latitude is '34.76x', .* a number"),
        (with_line(2, "2,,-117.0107413,15,10"), "line 2: latitude is '', expected a number"),
        (with_line(2, "2.5,34.76,-117.01,15,10"), "line 2: waypoint number is '2.5', .* whole"),
        (with_line(2, "2,91,-117.0107413,15,10"), "line 2: latitude is '91', .* -90 to 90"),
        (with_line(2, "2,nan,-117.0107413,15,10"), "line 2: latitude is 'nan', .* -90 to 90"),
        (with_line(2, "2,34.7607515,-181,15,10"), "line 2: longitude is '-181', .* -180 to 180"),
        (with_line(2, "2,34.7607515,-117.0107413,-15,10"), "line 2: boundary .* feet above 0"),
        (with_line(2, "2,34.7607515,-117.0107413,0,10"), "line 2: boundary .* feet above 0"),
        (with_line(2, "2,34.7607515,-117.0107413,inf,10"), "line 2: boundary .* feet above 0"),
        (with_line(2, "2,34.7607515,-117.0107413,15,-1"), "line 2: speed limit is '-1', .* 0 or"),
        (with_line(2, "2,34.7607515,-117.0107413,15,nan"), "line 2: speed limit is 'nan'"),
        (with_line(2, "2,34.7607515,-117.0107413,15,0"), "line 2: speed limit is 0 before the fin"),
        (
            with_line(2, "3,34.7607515,-117.0107413,15,10"),
            "line 2: waypoint number 3 .* expected 2",
        ),
        (
            with_line(2, "0,34.7607515,-117.0107413,15,10"),
            "line 2: waypoint number 0 .* expected 2",
        ),
        (with_line(2, "2,34.7607233,-117.0107599,15,10"), "line 2: a zero-length segment"),
        (with_line(2, "2,34.8607233,-117.0107599,15,10"), "line 2: 11094 m .* at most 10000 m"),
        (GOOD.splitlines()[0], "one waypoint, expected a route file of at least two"),
        ("", "an empty file, expected a route file"),
        ("<html><body>Not found</body></html>", "line 1: '<html>.* has 1 columns, latitude is mis"),
        ("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "line 1: .* has 1 columns"),
    ],
)
def test_bad_files_are_refused_in_one_line(text, message):
    with pytest.raises(RouteError, match="(?s)^bad.txt.*" + message) as caught:
        parse(text, "bad.txt")
    assert "\n" not in str(caught.value)


def test_blank_lines_do_not_shift_line_numbers():
    with pytest.raises(RouteError, match="line 4: latitude"):
        parse("\n\n" + with_line(2, "2,x,-117,15,10"), "bad.txt")


def test_stretch_names_the_valid_range():
    route = parse(GOOD, "good.txt")
    assert route.stretch(2, 3).number.tolist() == [2, 3]
    for first, last in ((0, 2), (2, 4), (2, 2), (3, 1)):
        with pytest.raises(RouteError, match=r"good\.txt: .*numbers from 1 to 3"):
            route.stretch(first, last)


@pytest.mark.skipif(not GC04.exists(), reason=f"{GC04} is not here: real data is not committed")
def test_the_real_race():
    route = parse(GC04.read_text(), GC04.name)
    assert len(route) == 2586
    assert route.speed_mps[-1] == 0.0
    part = route.stretch(2053, 2586)
    assert len(part) == 534
    assert np.median(part.half_width_m) == pytest.approx(8 * 0.3048)
