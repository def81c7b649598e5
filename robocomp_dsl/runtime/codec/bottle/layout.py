"""How values of IDSL are laid out in a Bottle, where YARP's own programs differ."""

from __future__ import annotations

import enum


class Layout(enum.StrEnum):
    """`YARP`: a type of ROS that YARP has, too, is written as YARP does: an image is an image.

    `FIELDS`: every struct is the list of its fields. `THRIFT`: as code of `yarpidl_thrift`: a
    struct within a message has no list of its own, and bools are `[ok]` and `[fail]`.
    """

    YARP = "yarp"
    FIELDS = "fields"
    THRIFT = "thrift"
