"""One line of the tape: a message, when it was delivered, and its bytes."""

import re
from functools import cache
from typing import NamedTuple

from nav.messages import LidarScan, Message
from tape.codec import Carried, encode
from tape.instruments import MEASURED, DriveTorque
from tape.truth import TRUTH, TrueState

PREFIX = "/tape/"
"""Only topics below it are replayed and digested."""
PROFILE = "ion-tape"
"""How an MCAP file says that it is a tape of ours."""


class Record(NamedTuple):
    """Made once for each message that crosses the boundary; digest, tape and view share it."""

    topic: str
    delivery_ns: int
    """When the message was handed over; when it was measured is `message.time_ns`."""
    message: Carried
    payload: bytes


def record(delivery_ns: int, message: Message) -> Record:
    """The record of a message that was delivered at `delivery_ns`.

    Raises:
        CodecError: the message would not survive the tape bit for bit.
    """
    return Record(topic(message), delivery_ns, message, encode(message))


def record_of_truth(state: TrueState) -> Record:
    """What nobody delivered: it stands on the tape at its own time."""
    return Record(f"{TRUTH}vehicle", state.time_ns, state, encode(state))


def record_of_torque(delivery_ns: int, torque: DriveTorque) -> Record:
    """The record of what a torque meter said."""
    return Record(f"{MEASURED}drive_torque", delivery_ns, torque, encode(torque))


def topic(message: Message) -> str:
    """Where a message goes: `/tape/gps_fix`; a scan by its sensor, `/tape/lidar_bumper`."""
    if isinstance(message, LidarScan):
        return PREFIX + message.sensor
    return _topic(type(message))


@cache
def _topic(kind: type) -> str:
    return PREFIX + re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__).lower()
