"""A laser scan in the wire format of ROS 1: by the codec of the middleware, and by rosbags."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from rosbags.typesys import Stores, get_typestore

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.decoder import decoder_function
from robocomp_dsl.runtime.codec.encoder import encoder_function
from robocomp_dsl.runtime.codec.wire_profile import ROS1
from robocomp_dsl.runtime.data.schema import UINT32

RAYS = 360
SCAN = "sensor_msgs/msg/LaserScan"


class Time(rt.Struct, type_id="builtin_interfaces/msg/Time"):
    """As generated."""

    sec: rt.Int = 0
    nanosec: UINT32 = 0


class Header(rt.Struct, type_id="std_msgs/msg/Header"):
    """As generated."""

    stamp: Time = rt.default()
    frame_id: rt.String = ""


class LaserScan(rt.Struct, type_id=SCAN):
    """As generated."""

    header: Header = rt.default()
    angle_min: rt.Float = 0.0
    angle_max: rt.Float = 0.0
    angle_increment: rt.Float = 0.0
    time_increment: rt.Float = 0.0
    scan_time: rt.Float = 0.0
    range_min: rt.Float = 0.0
    range_max: rt.Float = 0.0
    ranges: rt.Float32Array = rt.default()
    intensities: rt.Float32Array = rt.default()


@cache
def codecs() -> dict[str, Callable[[], Any]]:
    """Functions that encode and decode one scan, by the name of the codec."""
    rays = np.ones(RAYS, np.float32)
    scan = LaserScan(Header(Time(1, 2), "laser"), ranges=rays, intensities=rays)
    fields = (("", LaserScan),)
    encode = encoder_function(fields, "one", wire=ROS1)
    decode = decoder_function(fields, "one", ROS1)
    store: Any = get_typestore(Stores.ROS1_NOETIC)
    theirs = store.deserialize_ros1(encode(scan), SCAN)
    return {
        "ros1": lambda: decode(encode(scan)),
        "rosbags": lambda: store.deserialize_ros1(store.serialize_ros1(theirs, SCAN), SCAN),
    }
