"""The messages of the benchmark of bridges."""

from __future__ import annotations

from robocomp_dsl.runtime import types as rt


class Time(rt.Struct, type_id="builtin_interfaces/msg/Time"):
    """An instant."""

    sec: rt.Int = 0
    nanosec: rt.UInt32 = 0


class Header(rt.Struct, type_id="std_msgs/msg/Header"):
    """The header of a message."""

    stamp: Time = rt.default()
    frame_id: rt.String = ""


class JointState(rt.Struct, type_id="sensor_msgs/msg/JointState"):
    """The state of joints."""

    header: Header = rt.default()
    name: list[rt.String] = rt.default()
    position: rt.Float64Array = rt.default()
    velocity: rt.Float64Array = rt.default()
    effort: rt.Float64Array = rt.default()


class Image(rt.Struct, type_id="sensor_msgs/msg/Image"):
    """An image."""

    header: Header = rt.default()
    height: rt.UInt32 = 0
    width: rt.UInt32 = 0
    encoding: rt.String = ""
    is_bigendian: rt.Byte = 0
    step: rt.UInt32 = 0
    data: rt.UInt8Array = rt.default()


NUMBERS = rt.Interface(
    "Bench::Numbers", rt.Operation("push", rt.Pattern.PUBLISH, {"numbers": rt.Float64Array})
)
STATES = rt.Interface(
    "Bench::States", rt.Operation("send", rt.Pattern.PUBLISH, {"message": JointState})
)
IMAGES = rt.Interface("Bench::Images", rt.Operation("send", rt.Pattern.PUBLISH, {"message": Image}))
PICTURES = rt.Interface(
    "EyeTypes::PictureTopic", rt.Operation("send", rt.Pattern.PUBLISH, {"message": Image})
)
