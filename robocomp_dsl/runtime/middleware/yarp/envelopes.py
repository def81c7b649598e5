"""Envelopes of YARP messages: `42 1234.5`, a sequence number and seconds.

In: the text of an envelope, or a stamp. Out: the other. YARP's own type is `yarp::os::Stamp`, whose
time is a float64; decimals beyond it are kept.
"""

from __future__ import annotations

import re

from robocomp_dsl.runtime.connection.message_stamp import MessageStamp

_DECIMAL = re.compile(r"(-?)(\d{1,12})(?:\.(\d*))?")
_INT32 = 1 << 32
_MAX_S = 1e12


def read_envelope(envelope: str, arrived_ns: int) -> MessageStamp:
    """The stamp of a message; its arrival if the envelope is empty or no stamp of YARP."""
    words = envelope.split()
    if len(words) >= 2:
        time_ns = _nanoseconds(words[1])
        try:
            number = int(words[0])
        except ValueError:
            time_ns = None
        if time_ns is not None:
            return MessageStamp(time_ns, "envelope", number)
    return MessageStamp(arrived_ns, "arrival")


def _nanoseconds(text: str) -> int | None:
    """The ns of a number of seconds; None if it is none."""
    if found := _DECIMAL.fullmatch(text):
        sign, whole, decimals = found[1], found[2], (found[3] or "")[:9]
        time_ns = int(whole) * 1_000_000_000 + int(decimals.ljust(9, "0"))
        return -time_ns if sign else time_ns
    try:
        seconds = float(text)
    except ValueError:
        return None
    return round(seconds * 1e9) if abs(seconds) < _MAX_S else None


def write_envelope(stamp: MessageStamp, number: int) -> str:
    """The envelope of a stamp; `number` is its sequence number if it has none."""
    sequence = number if stamp.sequence is None else stamp.sequence
    sequence = (sequence + _INT32 // 2) % _INT32 - _INT32 // 2  # an int32, which wraps around
    whole, decimals = divmod(abs(stamp.time_ns), 1_000_000_000)
    text = f"{whole}.{decimals:09}".rstrip("0").rstrip(".")
    return f"{sequence} {'-' if stamp.time_ns < 0 else ''}{text}"
