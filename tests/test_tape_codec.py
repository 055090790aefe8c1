"""decode(encode(m)) is m, in bits, dtype and layout, for every type of message."""

import math
import struct
from dataclasses import fields
from enum import IntEnum

import numpy as np
import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy

from nav.messages import (
    MESSAGE_TYPES,
    CompassHeading,
    DirectCommand,
    Floats,
    FollowPath,
    Gear,
    LidarScan,
    SonarScan,
    VehicleState,
    lidar_range_m,
)
from tape.codec import decode, encode
from tape.errors import CodecError
from tape.schemas import schema, schema_name

DOUBLES = st.floats(width=64, allow_nan=True, allow_infinity=True)
"""All bit patterns that hypothesis knows: signed zeros, subnormals, infinities, NaNs."""
SCALARS = {
    int: st.integers(-(2**63), 2**63 - 1),
    float: DOUBLES,
    bool: st.booleans(),
    str: st.text(),
}
ARRAYS = st_numpy.arrays(
    np.float64, st_numpy.array_shapes(min_dims=1, max_dims=3, min_side=0), elements=DOUBLES
)
COUNTS = st_numpy.arrays(np.uint16, st.integers(0, 400))


def value(field):
    if "count" in field.metadata:
        return COUNTS.map(lidar_range_m)
    if field.type is Floats:
        return ARRAYS
    if issubclass(field.type, IntEnum):
        return st.sampled_from(field.type)
    return SCALARS[field.type]


def messages(kind):
    return st.builds(kind, **{f.name: value(f) for f in fields(kind)})


def bits(value):
    """What must be the same afterwards; floats by their bits, arrays by layout too."""
    if isinstance(value, np.ndarray):
        flags = (value.flags.c_contiguous, value.flags.writeable, value.flags.owndata)
        return value.dtype, value.shape, value.strides, flags, value.tobytes()
    if isinstance(value, float):
        return type(value), struct.pack("<d", value)
    return type(value), value


def assert_same(one, two):
    assert type(one) is type(two)
    for field in fields(one):
        assert bits(getattr(one, field.name)) == bits(getattr(two, field.name)), field.name


@pytest.mark.parametrize("kind", MESSAGE_TYPES, ids=lambda kind: kind.__name__)
def test_every_message_survives_bit_for_bit(kind):
    @settings(max_examples=40, deadline=None, database=None, derandomize=True)
    @given(messages(kind))
    def check(message):
        assert_same(decode(kind, encode(message)), message)

    check()


def test_every_count_survives():
    every = LidarScan(1, "lidar_roof", lidar_range_m(np.arange(65536, dtype=np.uint16)))
    assert_same(decode(LidarScan, encode(every)), every)


def test_a_scan_takes_two_bytes_a_beam():
    scan = LidarScan(10**12, "lidar_bumper", lidar_range_m(np.full(361, 8192, np.uint16)))
    assert len(encode(scan)) < 2 * 361 + 30


def test_a_strided_array_gets_the_layout_of_its_message():
    path = FollowPath(1, np.arange(40.0).reshape(2, 20).T[::2], 3.0)
    assert_same(decode(FollowPath, encode(path)), path)


@pytest.mark.parametrize(
    "range_m", [0.005, -0.01, -0.0, math.nan, math.inf, 655.36, 1e300, 35 / 100]
)
def test_a_range_that_is_no_count_is_refused(range_m):
    """35 / 100 is one bit beside 35 * 0.01."""
    with pytest.raises(CodecError, match=r"LidarScan: range_m\[1\] is .* m, expected"):
        encode(LidarScan(1, "lidar_roof", [1.0, range_m]))


@pytest.mark.parametrize(
    ("message", "complaint"),
    [
        (CompassHeading(2**63, 0.0), "out of range"),
        (CompassHeading(1.5, 0.0), "integer"),
        (CompassHeading(1, None), "None"),
        (CompassHeading(1, "east"), "float|number"),
        (DirectCommand(1, "\ud800"), "surrogates"),
        (SonarScan(1, 3.0), "expected an array"),
        (LidarScan(1, "lidar_roof", [[1.0]]), "one dimension"),
        (VehicleState(1, [0.0], 0.0, 0.0, 0.0, 7, False), "not a valid Gear"),
    ],
)
def test_what_would_not_survive_is_refused(message, complaint):
    with pytest.raises(CodecError, match=complaint):
        encode(message)


def test_numpy_scalars_come_back_as_plain_ones():
    state = VehicleState(np.int64(5), [1.0], np.float64(0.1), 0.0, 0.0, Gear.LOW, np.bool_(True))
    assert_same(
        decode(VehicleState, encode(state)),
        VehicleState(5, [1.0], 0.1, 0.0, 0.0, Gear.LOW, True),
    )


def test_bytes_that_are_no_message_are_refused():
    with pytest.raises(CodecError, match="3 bytes are no CompassHeading"):
        decode(CompassHeading, b"\xff\xff\xff")


def test_a_foreign_class_is_refused():
    with pytest.raises(CodecError, match=r"str is no message .* known are LidarScan"):
        encode("hello")


def test_the_published_schema_reads_the_same_numbers():
    """Foxglove decodes with `repeated double` what the codec wrote as bytes."""
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(schema(FollowPath)).file:
        pool.Add(file)
    descriptor = pool.FindMessageTypeByName(schema_name(FollowPath))
    path = FollowPath(7, np.arange(20.0).reshape(10, 2) / 3, 4.5)
    public = message_factory.GetMessageClass(descriptor).FromString(encode(path))
    assert (public.time_ns, public.speed_mps) == (7, 4.5)
    assert list(public.pathpoint_m) == path.pathpoint_m.ravel().tolist()
    assert list(public.pathpoint_m_shape) == [10, 2]
    assert public.SerializeToString() == encode(path)
