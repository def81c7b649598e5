"""Mutated messages on every wire: decoders return a value or raise `MalformedMessage`.

In: the number of bytes for each wire. Out: bytes, messages, how many were accepted, and by how much
the memory of the process grew.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.ice import codec as ice
from tests.runtime.ice_codec.test_ice_malformed import ARGUMENTS, EVERYTHING, mutated

BYTES = 10_000_000


def mutated_bytes(count: int = BYTES) -> dict[str, Any]:
    """Feed `count` mutated bytes to the decoder of each wire; any other exception propagates."""
    figures: dict[str, Any] = {}
    wires: dict[str, tuple[bytes, Callable[[bytes], Any]]] = {
        "CDR (zenoh, local, ROS 2)": (
            EVERYTHING.encode_request(ARGUMENTS),
            EVERYTHING.decode_request,
        ),
        "Ice 1.1": (ice.request_encoder(EVERYTHING)(ARGUMENTS), ice.request_decoder(EVERYTHING)),
    }
    for wire, (message, decode) in wires.items():
        source, before = random.Random(7), _resident_bytes()
        sent = messages = accepted = 0
        while sent < count:
            data = mutated(message, source)
            sent += len(data)
            messages += 1
            try:
                decode(data)
                accepted += 1
            except rt.MalformedMessage:
                pass
        growth = (_resident_bytes() - before) / 1e6
        figures |= {
            f"{wire}: bytes": sent,
            f"{wire}: messages": messages,
            f"{wire}: accepted": accepted,
            f"{wire}: memory grew by [MB]": growth,
        }
    return figures


def _resident_bytes() -> int:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")
