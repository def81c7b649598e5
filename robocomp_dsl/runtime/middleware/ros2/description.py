"""What the middleware `ros2` can do."""

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription
from robocomp_dsl.runtime.middleware.ros_common.valid_names import VALID_NAMES

MIDDLEWARE = MiddlewareDescription(
    name="ros2",
    summary="ROS 2 nodes through rclpy; ROS 2 or its Python packages must be installed",
    capabilities=Capabilities(
        between_hosts=True,
        external_peers=True,
        fixed_address=True,
        attaches_subscribers=True,
        latches=True,
        qos=frozenset({"reliable", "keep_all", "latched"}),
        valid_names=VALID_NAMES,
        ros_types_only=True,
    ),
    opener="robocomp_dsl.runtime.middleware.ros2.transport:open_transport",
    address_problem="robocomp_dsl.runtime.middleware.ros_common.valid_names:address_problem",
    requires=("rclpy",),
    install="source a ROS 2 workspace, or run: pip install 'robocomp_dsl[ros2]'",
)
