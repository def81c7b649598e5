"""What the middleware `dds` can do."""

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription
from robocomp_dsl.runtime.middleware.ros_common.valid_names import VALID_NAMES

MIDDLEWARE = MiddlewareDescription(
    name="dds",
    summary="topics of ROS 2 nodes on any DDS, through Cyclone DDS; no ROS needs to be installed",
    capabilities=Capabilities(
        between_hosts=True,
        services=False,
        external_peers=True,
        fixed_address=True,
        attaches_subscribers=True,
        latches=True,
        qos=frozenset({"reliable", "keep_all", "latched"}),
        valid_names=VALID_NAMES,
        ros_types_only=True,
    ),
    opener="robocomp_dsl.runtime.middleware.dds.transport:open_transport",
    address_problem="robocomp_dsl.runtime.middleware.ros_common.valid_names:address_problem",
    requires=("cyclonedds",),
    install="run: pip install 'robocomp_dsl[dds]'",
)
