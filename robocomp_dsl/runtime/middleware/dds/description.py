"""What the middleware `dds` can do."""

from dataclasses import replace

from robocomp_dsl.runtime.middleware.capabilities import MiddlewareDescription
from robocomp_dsl.runtime.middleware.ros_common.capabilities import ROS_2_CAPABILITIES

MIDDLEWARE = MiddlewareDescription(
    name="dds",
    summary="topics of ROS 2 nodes on any DDS, through Cyclone DDS; no ROS needs to be installed",
    capabilities=replace(ROS_2_CAPABILITIES, services=False),
    opener="robocomp_dsl.runtime.middleware.dds.transport:open_transport",
    address_problem="robocomp_dsl.runtime.middleware.ros_common.valid_names:address_problem",
    requires=("cyclonedds",),
    install="run: pip install 'robocomp_dsl[dds]'",
)
