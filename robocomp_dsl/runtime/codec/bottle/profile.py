"""The tags of wire types, which differ between YARP 3 and YARP 4.

In: the version of the peers. Out: tags by type, and types by tag. Tag 10 is a float64 for YARP 3
and a float32 for YARP 4: both sides of a connection need the same profile.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.bottle.values import Float32, Int8, Int16, Int64, Vocab, Vocab64

STRING, BLOB, LIST, DICT = 4, 12, 256, 768


@dataclass(frozen=True, slots=True)
class BottleScalar:
    """A type of fixed size: tag, format for `struct`, Python class, and the dtype of its lists."""

    tag: int
    form: struct.Struct
    type: type[Any]
    dtype: np.dtype[Any] | None


def _scalar(tag: int, form: str, type_: type[Any], dtype: str = "") -> BottleScalar:
    return BottleScalar(
        tag, struct.Struct(f"<{form}"), type_, np.dtype(f"<{dtype}") if dtype else None
    )


class Profile:
    """The tags of one major version."""

    def __init__(self, version: int) -> None:
        self.version = version
        scalars = [
            _scalar(32, "b", Int8, "i1"),
            _scalar(64, "h", Int16, "i2"),
            _scalar(1, "i", int, "i4"),
            _scalar(17, "q", Int64, "i8"),
            _scalar(9, "i", Vocab),
            _scalar(128 if version == 3 else 10, "f", Float32, "f4"),
            _scalar(10 if version == 3 else 20, "d", float, "f8"),
        ]
        if version > 3:
            scalars.append(_scalar(18, "q", Vocab64))
        self.by_tag = {scalar.tag: scalar for scalar in scalars}
        self.by_type = {scalar.type: scalar for scalar in scalars}
        self.by_dtype = {scalar.dtype: scalar for scalar in scalars if scalar.dtype}


PROFILE_3 = Profile(3)
PROFILE_4 = Profile(4)
PROFILES = {"3": PROFILE_3, "4": PROFILE_4}
