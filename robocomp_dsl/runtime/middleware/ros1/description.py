"""What the middleware `ros1` can do."""

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MAX_MESSAGE_BYTES = 1 << 30
"""Larger messages are refused by the sender, and by the receiver."""

MIDDLEWARE = MiddlewareDescription(
    name="ros1",
    summary="ROS 1 nodes, such as those of Noetic; no ROS needs to be installed",
    capabilities=Capabilities(
        between_hosts=True,
        external_peers=True,
        fixed_address=True,
        attaches_subscribers=True,
        qos=frozenset({"reliable", "keep_all", "latched"}),
        external_ros_types=True,
        actions=True,
        max_message_bytes=MAX_MESSAGE_BYTES,
    ),
    opener="robocomp_dsl.runtime.middleware.ros1.transport:open_transport",
    topic_types="robocomp_dsl.runtime.middleware.ros1.graph:topic_types",
    address_problem="robocomp_dsl.runtime.middleware.ros_common.valid_names:address_problem",
    requires=("rosbags",),
    install="run: pip install 'robocomp_dsl[ros]'",
)
