"""What every middleware to ROS 2 nodes can do."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.capabilities import Capabilities
from robocomp_dsl.runtime.middleware.ros_common.valid_names import VALID_NAMES

ROS_2_CAPABILITIES = Capabilities(
    between_hosts=True,
    external_peers=True,
    fixed_address=True,
    attaches_subscribers=True,
    latches=True,
    qos=frozenset({"reliable", "keep_all", "latched"}),
    valid_names=VALID_NAMES,
    ros_types_only=True,
)
