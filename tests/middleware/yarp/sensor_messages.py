"""Interfaces with messages of ROS, as the generator writes them."""

from __future__ import annotations

from robocomp_dsl.runtime import types as rt
from tests.middleware.ros2.ros_messages import Header


class Image(rt.Struct, type_id="sensor_msgs/msg/Image"):
    header: Header = rt.default()
    height: rt.UInt32 = 0
    width: rt.UInt32 = 0
    encoding: rt.String = ""
    is_bigendian: rt.Byte = 0
    step: rt.UInt32 = 0
    data: rt.UInt8Array = rt.default()


CAMERA = rt.Interface("Test::Camera", rt.Operation("push", rt.Pattern.PUBLISH, {"image": Image}))
