"""The mapping between world and geodetic coordinates, against pyproj."""

import numpy as np
import pytest

from twin.earth import to_geodetic, to_world

ANCHORS = [(34.1, -117.5), (0.0, 0.0), (-45.0, 179.9999), (70.0, 10.0)]


@pytest.fixture
def points_m():
    return np.random.default_rng(1).uniform(-60_000.0, 60_000.0, (2, 500))


@pytest.mark.parametrize("anchor", ANCHORS)
def test_round_trip(anchor, points_m):
    latitude, longitude = to_geodetic(anchor, *points_m)
    np.testing.assert_allclose(to_world(anchor, latitude, longitude), points_m, atol=1e-6)
    again = to_geodetic(anchor, *to_world(anchor, latitude, longitude))
    np.testing.assert_allclose(again, (latitude, longitude), atol=1e-9, rtol=0.0)


@pytest.mark.parametrize("anchor", ANCHORS)
def test_agrees_with_pyproj(anchor, points_m):
    pyproj = pytest.importorskip("pyproj")
    pipeline = pyproj.Transformer.from_pipeline(
        "+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad +step +proj=cart"
        f" +step +proj=topocentric +lat_0={anchor[0]} +lon_0={anchor[1]} +h_0=0"
    )
    latitude, longitude = to_geodetic(anchor, *points_m)
    east, north, _ = pipeline.transform(longitude, latitude, np.zeros_like(latitude))
    np.testing.assert_allclose((east, north), points_m, atol=1e-6)


def test_the_anchor_is_the_origin():
    assert to_world(ANCHORS[0], *ANCHORS[0]) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert to_geodetic(ANCHORS[0], 0.0, 0.0) == pytest.approx(ANCHORS[0], abs=1e-12)


def test_scalars_and_shapes():
    latitude, longitude = to_geodetic(ANCHORS[0], np.zeros((2, 3)), np.ones((2, 3)))
    assert latitude.shape == longitude.shape == (2, 3)
    assert to_world(ANCHORS[0], latitude, longitude)[0].shape == (2, 3)
