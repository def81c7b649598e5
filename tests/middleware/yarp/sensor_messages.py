"""Interfaces with messages of ROS, as the generator writes them."""

from __future__ import annotations

import numpy as np

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
LEVELS = rt.Interface(
    "Test::Levels",
    rt.Operation("set", rt.Pattern.PUBLISH, {"levels": dict[rt.String, rt.Double]}),
)
_PIXEL = {"rgb8": 3, "mono8": 1, "mono16": 2, "bgra8": 4, "32FC1": 4, "bayer_rggb8": 1}


def image_of(encoding: str, width: int, height: int, *, step: int) -> Image:
    """An image whose bytes differ; `step` are the bytes of a row."""
    data = (np.arange(step * height) % 251).astype(np.uint8)
    return Image(Header(), height, width, encoding, 0, step, data)


def pixels_of(image: Image) -> bytes:
    """The pixels without what pads the rows."""
    rows = np.asarray(image.data).reshape(image.height, image.step)
    return rows[:, : image.width * _PIXEL[image.encoding]].tobytes()
