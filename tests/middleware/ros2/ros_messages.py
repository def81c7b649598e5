"""Types of ROS, and interfaces of them, as they are generated from `.msg` and `.srv` files."""

from __future__ import annotations

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.data.schema import UINT32


class Time(rt.Struct, type_id="builtin_interfaces/msg/Time"):
    sec: rt.Int = 0
    nanosec: UINT32 = 0


class Header(rt.Struct, type_id="std_msgs/msg/Header"):
    stamp: Time = rt.default()
    frame_id: rt.String = ""


class LaserScan(rt.Struct, type_id="sensor_msgs/msg/LaserScan"):
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


class String(rt.Struct, type_id="std_msgs/msg/String"):
    data: rt.String = ""


class SmallInt(rt.Struct, type_id="std_msgs/msg/Int16"):
    data: rt.Short = 0


class SetBoolRequest(rt.Struct, type_id="std_srvs/srv/SetBool_Request"):
    data: rt.Bool = False


class SetBoolResponse(rt.Struct, type_id="std_srvs/srv/SetBool_Response"):
    success: rt.Bool = False
    message: rt.String = ""


class TriggerRequest(rt.Struct, type_id="std_srvs/srv/Trigger_Request"):
    pass


class TriggerResponse(rt.Struct, type_id="std_srvs/srv/Trigger_Response"):
    success: rt.Bool = False
    message: rt.String = ""


SWITCH = rt.Interface(
    "Robot::Switch",
    rt.Operation("set", inputs={"request": SetBoolRequest}, returns=SetBoolResponse),
)
BASE = rt.Interface(
    "Robot::Base",
    rt.Operation("enable", inputs={"request": SetBoolRequest}, returns=SetBoolResponse),
    rt.Operation("stop", inputs={"request": TriggerRequest}, returns=TriggerResponse),
    rt.Operation("say", rt.Pattern.COMMAND, inputs={"text": String}),
)
OTHER_SWITCH = rt.Interface(
    "Robot::Switch",
    rt.Operation("set", inputs={"request": TriggerRequest}, returns=TriggerResponse),
)
CHAT = rt.Interface("Robot::Chat", rt.Operation("said", rt.Pattern.PUBLISH, {"text": String}))
OTHER_CHAT = rt.Interface(
    "Robot::Chat", rt.Operation("said", rt.Pattern.PUBLISH, {"number": SmallInt})
)
SCAN = rt.Interface("Robot::Scan", rt.Operation("scanned", rt.Pattern.PUBLISH, {"scan": LaserScan}))
