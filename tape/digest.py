"""One number for everything that crossed the boundary: the same episode, the same digest."""

import hashlib
from dataclasses import dataclass

from tape.record import Record


@dataclass
class Digest:
    """h = sha256(h + topic + time_ns + payload), over records in order of delivery.

    Its whole state is 32 bytes, so it pickles in the middle of an episode and goes on.
    """

    state: bytes = bytes(32)

    def update(self, record: Record) -> None:
        """Take the next record; its delivery time enters as 8 bytes, little-endian, signed."""
        head = self.state + record.topic.encode()
        time = record.delivery_ns.to_bytes(8, "little", signed=True)
        self.state = hashlib.sha256(head + time + record.payload).digest()

    def hex(self) -> str:
        """The digest so far, 64 hexadecimal digits."""
        return self.state.hex()
