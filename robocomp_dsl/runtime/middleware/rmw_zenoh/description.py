"""What the middleware `rmw_zenoh` can do."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription
from robocomp_dsl.runtime.middleware.ros_common.valid_names import VALID_NAMES

MIDDLEWARE = MiddlewareDescription(
    name="rmw_zenoh",
    summary="ROS 2 nodes on rmw_zenoh; no ROS needs to be installed",
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
    opener="robocomp_dsl.runtime.middleware.rmw_zenoh.transport:open_transport",
    address_problem="robocomp_dsl.runtime.middleware.ros_common.valid_names:address_problem",
    requires=("zenoh",),
    install="run: pip install eclipse-zenoh",
)
