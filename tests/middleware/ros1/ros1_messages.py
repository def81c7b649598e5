"""Messages of ROS as they are generated, besides those in `ros2.ros_messages`."""

from __future__ import annotations

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.data.schema import UINT32
from tests.middleware.ros2.ros_messages import Header, String, Time


class Image(rt.Struct, type_id="sensor_msgs/msg/Image"):
    header: Header = rt.default()
    height: UINT32 = 0
    width: UINT32 = 0
    encoding: rt.String = ""
    is_bigendian: rt.Byte = 0
    step: UINT32 = 0
    data: rt.UInt8Array = rt.default()


class Custom(rt.Struct, type_id="lab_msgs/msg/Custom"):
    header: Header = rt.default()
    at: Time = rt.default()
    names: list[String] = rt.default()
    values: rt.Float32Array = rt.default()
    count: rt.Short = 0


CUSTOM_TEXT = """std_msgs/Header header
time at
std_msgs/String[] names
float32[] values
int16 count
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
================================================================================
MSG: std_msgs/String
string data
"""
IMAGES = rt.Interface("Robot::Images", rt.Operation("taken", rt.Pattern.PUBLISH, {"image": Image}))
CUSTOMS = rt.Interface(
    "Robot::Customs", rt.Operation("made", rt.Pattern.PUBLISH, {"custom": Custom})
)
