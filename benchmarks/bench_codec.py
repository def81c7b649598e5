"""The codec against the least that Python can do: the same bytes by `struct` and numpy, by hand.

Encoding and decoding of a pose, a laser scan and a skin frame, in turns, in one run.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from statistics import median
from time import perf_counter_ns
from typing import Any

import numpy as np

from benchmarks.pose_interface import Pose
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.codec import compile_decoder, compile_encoder

ROUNDS = 40
CALLS = 400


class Beam(rt.Struct):
    """One ray."""

    angle: rt.Float = 0.0
    dist: rt.Float = 0.0


class Scan(rt.StructArray[Beam]):
    """A laser scan."""

    __slots__ = ()


class Frame(rt.Struct):
    """Of a skin: which taxels, and what they feel."""

    stamp: rt.Double
    ids: rt.Int16Array
    values: rt.Float32Array


def trip(kind: Any, value: Any) -> Callable[[], Any]:
    """Encode and decode one value."""
    encode, decode = compile_encoder((("v", kind),)), compile_decoder((("v", kind),))
    return lambda: decode(encode((value,)))


def by_hand() -> Callable[[], Any]:
    """A pose without names: eight numbers and a text."""
    numbers, length = struct.Struct("<4s8dI"), struct.Struct("<I")
    header = b"\0\1\0\0"

    def work() -> tuple[float, ...]:
        text = b"base_frame\0"
        data = numbers.pack(header, *(0.5,) * 8, len(text)) + text
        size = length.unpack_from(data, 68)[0]
        return (*numbers.unpack_from(data)[1:9], data[72 : 71 + size].decode())

    return work


def run() -> list[dict[str, Any]]:
    """All figures."""
    beams = np.zeros(1000, dtype=[("angle", "<f4"), ("dist", "<f4")])
    scan = Scan.from_columns(angle=beams["angle"], dist=beams["dist"])
    frame = Frame(1.0, np.arange(4000, dtype=np.int16), np.ones(4000, dtype=np.float32))
    works = {
        "pose by struct, by hand": by_hand(),
        "pose": trip(Pose, Pose()),
        "scan of 1000 rays": trip(Scan, scan),
        "skin frame of 4000 taxels": trip(Frame, frame),
    }
    took: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(ROUNDS):
        for name, work in works.items():
            start = perf_counter_ns()
            for _ in range(CALLS):
                work()
            took[name].append((perf_counter_ns() - start) / CALLS / 1000)
    goals = {"pose": 3.0, "scan of 1000 rays": 5.0, "skin frame of 4000 taxels": 5.0}
    figures: list[dict[str, Any]] = [
        {
            "name": f"{name}, encode and decode",
            "value": median(times),
            "unit": "us",
            "goal": goals.get(name),
        }
        for name, times in took.items()
    ]
    pairs = zip(took["pose"], took["pose by struct, by hand"], strict=True)
    ratio = median(ours / theirs for ours, theirs in pairs)
    return [*figures, {"name": "pose / by hand", "value": ratio, "unit": "x"}]
