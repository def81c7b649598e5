"""What differs between the wire formats that the generated codecs know: CDR and that of ROS 1.

In: a struct. Out: what a message has in front of its fields. ROS 1 has no padding and no header in
front of a message, its strings end without NUL, and its `std_msgs/Header` has a counter `seq` that
that of ROS 2, which our structs follow, has not (http://wiki.ros.org/msg; genmsg, genpy).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

ROS_HEADER = "std_msgs/msg/Header"
SEQ_BYTES = 4
"""Size of `seq`."""
MAX_EMPTY_ELEMENTS = 1 << 16
"""Elements without bytes of a sequence: no message size limits them."""


@dataclass(frozen=True, slots=True)
class WireProfile:
    """One format. Sizes in bytes.

    `header` is the number of 4 bytes in front of a message; None: there is none. `aligned`:
    numbers are aligned to their size. `terminated`: a string ends with NUL, which its length
    includes. `pads_empty`: a struct without fields is one byte. `has_seq`: headers of ROS start
    with a counter.
    """

    header: int | None
    aligned: bool
    terminated: bool
    pads_empty: bool
    has_seq: bool

    @property
    def start(self) -> int:
        """Size of the header."""
        return 0 if self.header is None else 4

    def alignment(self, size: int) -> int:
        """The alignment of a number of `size` bytes."""
        return size if self.aligned else 1

    def inserts_seq(self, type_: Any) -> bool:
        """Whether a struct starts with a `seq` that it does not declare."""
        if not self.has_seq or getattr(type_, "_type_id_", "") != ROS_HEADER:
            return False
        return all(name != "seq" for name, _ in type_._fields_)


CDR = WireProfile(0x0100, aligned=True, terminated=True, pads_empty=True, has_seq=False)
"""CDR, little endian, no options: the header 00 01 00 00 as a little-endian number."""
ROS1 = WireProfile(None, aligned=False, terminated=False, pads_empty=False, has_seq=True)
