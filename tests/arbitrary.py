"""Strategies for hypothesis: any messages of sensors, good, spoilt or absurd."""

from dataclasses import fields
from typing import Any

import numpy as np
from hypothesis import strategies as st

from nav.messages import (
    CompassHeading,
    Floats,
    Gear,
    GpsFix,
    GpsQuality,
    ImuSample,
    LidarScan,
    RadarTracks,
    RoadEstimate,
    SensorMessage,
    SonarScan,
    VehicleState,
)

KINDS = (LidarScan, SonarScan, GpsFix, ImuSample, CompassHeading, VehicleState, RadarTracks,
         RoadEstimate)  # fmt: skip
ODD = (
    0.0, -0.0, 1e-310, 1.0, -1.0, 1.4, -1.5707963267948966, 6.2, -30.0, 45.0, 82.0, -89.9, 179.9,
    195.0, -900.0, 1e3, -1e5, 1e9, 1e18, 1e100, -1e160, 1.7e308,
    float("inf"), float("-inf"), float("nan"),
)  # fmt: skip
"""Zeros, a subnormal, what just passes for one field or another, the absurd, and no numbers."""
LAGS_NS = (0, 1, -1, -10_000_000, 40_000_000, 60_000_000, -400_000_000, -600_000_000, 10**18,
           -(10**18))  # fmt: skip
"""How far a stamp is ahead of the time that it should be."""

numbers = st.sampled_from(ODD) | st.floats() | st.floats(-7.0, 7.0)
lags_ns = st.sampled_from(LAGS_NS)
scanners = st.sampled_from(["lidar_bumper", "lidar_roof", "lidar_left", "", "odometry", "lidar"])


@st.composite
def arrays(draw: st.DrawFn) -> Floats:
    """One number over and over and another among it; now and then of two dimensions."""
    array = np.full(draw(st.sampled_from([0, 1, 2, 3, 6, 7, 8, 181, 361, 362])), draw(numbers))
    if array.size:
        array[draw(st.integers(0, array.size - 1))] = draw(numbers)
    return array[None] if draw(st.integers(0, 9)) == 5 else array


_OF_TYPE: dict[Any, st.SearchStrategy[Any]] = {
    float: numbers, Floats: arrays(), int: st.integers(0, 12), str: scanners, bool: st.booleans(),
    Gear: st.sampled_from(Gear), GpsQuality: st.sampled_from(GpsQuality),
}  # fmt: skip


def _of_kind(kind: type[Any]) -> st.SearchStrategy[SensorMessage]:
    said = {f.name: _OF_TYPE[f.type] for f in fields(kind) if f.name != "time_ns"}
    return st.builds(kind, time_ns=lags_ns, **said)


messages = st.one_of([_of_kind(kind) for kind in KINDS])
"""Their `time_ns` is relative to the call's."""
