"""What the twin and the navigator must both know is written twice, since neither may import the
other; here the two are held together."""

import numpy as np
import pytest

from nav.parameters import parameters_from
from nav.route.geodesy import Frame
from scenarios.parameter_files import parameter_texts
from twin import earth
from twin.sensors.parameters import sensor_parameters

VEHICLE = parameters_from(parameter_texts()).vehicle
SENSORS = sensor_parameters()


def test_lidars_have_the_same_names_and_the_same_fan():
    assert tuple(SENSORS.lidar.units) == tuple(VEHICLE.lidar_mounts)
    assert SENSORS.lidar.beams == VEHICLE.lidar.count
    assert SENSORS.lidar.half_fan_rad == pytest.approx(-VEHICLE.lidar.first_rad)


def test_sonars_come_in_the_same_order_with_the_same_range():
    assert tuple(SENSORS.sonar.units) == tuple(VEHICLE.sonar_mounts)
    assert SENSORS.sonar.max_range_m == VEHICLE.sonar.max_range_m


def test_the_radar_is_as_wrong_as_the_map_believes():
    assert list(VEHICLE.radars) == ["radar"]
    twin, nav = SENSORS.radar, VEHICLE.radars["radar"]
    assert twin.range_error_m == nav.range_error_m
    assert twin.range_error_share == nav.range_error_share
    brackets = 2.0 * SENSORS.mounting.angle_sd_rad
    assert twin.azimuth_error_rad + brackets < nav.azimuth_error_rad


def test_both_map_the_earth_alike():
    anchor = (34.09, -117.50)
    xy = np.random.default_rng(1).uniform(-20_000, 20_000, (50, 2))
    latitude, longitude = earth.to_geodetic(anchor, xy[:, 0], xy[:, 1])
    np.testing.assert_allclose(Frame(*anchor).to_local(latitude, longitude), xy, atol=1e-6)
