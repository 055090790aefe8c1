"""Another vehicle's file says only what it has otherwise."""

import pytest

from nav.parameters import FILES, ParameterError, files_of, parameters_from
from scenarios.parameter_files import parameter_texts

TEXTS = parameter_texts()
ION = parameters_from(TEXTS)


def other(text):
    return parameters_from({**TEXTS, "cart.toml": text}, "cart")


def test_ion_needs_no_file_of_its_own():
    assert files_of("ion") == FILES == tuple(TEXTS)


def test_what_the_file_does_not_say_stays():
    assert other("") == ION
    cart = other("[vehicle.outline]\nfront_m = 0.3\n[planning.scanning]\ndirections = 61")
    assert cart.vehicle.outline.front_m == 0.3
    assert cart.vehicle.outline.rear_m == ION.vehicle.outline.rear_m
    assert cart.planning.scanning.directions == 61
    assert cart.steering == ION.steering


def test_mounts_are_replaced_as_a_whole():
    mount = (
        "[vehicle.lidar_mounts.laser]\nposition_m = [0.1, 0.0, 0.2]\nyaw_rad = 0.0\npitch_rad = 0.0"
    )
    assert list(other(mount).vehicle.lidar_mounts) == ["laser"]
    assert other("[vehicle]\nsonar_mounts = {}").vehicle.sonar_mounts == {}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[vehicel]", "cart.toml: vehicel: unknown table; known are vehicle,"),
        ("[vehicle]\nwheels = 6", "cart.toml: vehicle.wheels: unknown key"),
        (
            "[vehicle]\ntrack_m = 'wide'",
            "cart.toml: vehicle.track_m: 'wide' is str, expected float",
        ),
        ("[vehicle", "cart.toml: not TOML"),
    ],
)
def test_what_is_wrong_is_refused(text, message):
    with pytest.raises(ParameterError, match=message.replace("[", r"\[")):
        other(text)


def test_a_missing_file_is_named():
    with pytest.raises(ParameterError, match=r"cart.toml: missing"):
        parameters_from(TEXTS, "cart")
