"""What the middleware `rmw_zenoh` can do."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.capabilities import MiddlewareDescription
from robocomp_dsl.runtime.middleware.ros_common.capabilities import ROS_2_CAPABILITIES

MIDDLEWARE = MiddlewareDescription(
    name="rmw_zenoh",
    summary="ROS 2 nodes on rmw_zenoh; no ROS needs to be installed",
    capabilities=ROS_2_CAPABILITIES,
    opener="robocomp_dsl.runtime.middleware.rmw_zenoh.transport:open_transport",
    address_problem="robocomp_dsl.runtime.middleware.ros_common.valid_names:address_problem",
    requires=("zenoh",),
    install="run: pip install eclipse-zenoh",
)
