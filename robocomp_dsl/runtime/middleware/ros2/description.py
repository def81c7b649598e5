"""What the middleware `ros2` can do."""

from robocomp_dsl.runtime.middleware.capabilities import MiddlewareDescription
from robocomp_dsl.runtime.middleware.ros_common.capabilities import ROS_2_CAPABILITIES

MIDDLEWARE = MiddlewareDescription(
    name="ros2",
    summary="ROS 2 nodes through rclpy; ROS 2 or its Python packages must be installed",
    capabilities=ROS_2_CAPABILITIES,
    opener="robocomp_dsl.runtime.middleware.ros2.transport:open_transport",
    address_problem="robocomp_dsl.runtime.middleware.ros_common.valid_names:address_problem",
    requires=("rclpy",),
    install="source a ROS 2 workspace, or run: pip install 'robocomp_dsl[ros2]'",
)
