import pickle
from timeit import repeat

import numpy as np
import pytest

from nav.route.geodesy import Frame

pyproj = pytest.importorskip("pyproj", reason="pyproj is the oracle of the geodesy")

ANCHORS = [(34.76, -117.01), (-33.9, 151.2), (0.0, 0.0), (64.1, -21.9)]


def oracle(anchor, lat, lon):
    enu = pyproj.Transformer.from_pipeline(
        "+proj=pipeline +step +proj=cart +ellps=WGS84 "
        f"+step +proj=topocentric +ellps=WGS84 +lat_0={anchor[0]} +lon_0={anchor[1]} +h_0=0"
    )
    east, north, _ = enu.transform(lon, lat, np.zeros_like(lat))
    return np.column_stack([east, north])


def around(anchor, spread_deg=1.5, count=500):
    offset = np.random.default_rng(1).uniform(-spread_deg, spread_deg, (2, count))
    return anchor[0] + offset[0], anchor[1] + offset[1]


@pytest.mark.parametrize("anchor", ANCHORS)
def test_agrees_with_pyproj(anchor):
    lat, lon = around(anchor)
    np.testing.assert_allclose(
        Frame(*anchor).to_local(lat, lon), oracle(anchor, lat, lon), rtol=0, atol=1e-7
    )


@pytest.mark.parametrize("anchor", ANCHORS)
def test_there_and_back(anchor):
    frame, (lat, lon) = Frame(*anchor), around(anchor)
    back = frame.to_geodetic(frame.to_local(lat, lon))
    np.testing.assert_allclose(back, (lat, lon), rtol=0, atol=1e-12)


def test_one_point_is_the_same_as_many():
    frame, (lat, lon) = Frame(34.76, -117.01), around((34.76, -117.01), 0.5, 50)
    points = [frame.point(*place) for place in zip(lat, lon, strict=True)]
    np.testing.assert_allclose(points, frame.to_local(lat, lon), rtol=0, atol=1e-8)


def test_east_and_north_are_where_they_belong():
    frame = Frame(45.0, 10.0)
    assert frame.point(45.0, 10.0) == (0.0, 0.0)
    east, north = frame.point(45.001, 10.001)
    assert (round(east), round(north)) == (79, 111)


def test_one_fix_costs_less_than_ten_microseconds():
    frame = Frame(34.76, -117.01)
    assert min(repeat(lambda: frame.point(34.77, -117.02), number=1000, repeat=5)) < 10e-3


def test_pickles_and_compares():
    frame = Frame(34.76, -117.01)
    again = pickle.loads(pickle.dumps(frame))
    assert again == frame
    assert again.point(34.77, -117.02) == frame.point(34.77, -117.02)
