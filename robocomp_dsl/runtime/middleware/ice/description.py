"""ice: components and programs written with ZeroC Ice, such as those of RoboComp."""

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MIDDLEWARE = MiddlewareDescription(
    name="ice",
    summary="ZeroC Ice 3.7: programs written with Ice, such as RoboComp's C++ components",
    capabilities=Capabilities(
        topic_versions=True,
        between_hosts=True,
        external_peers=True,
        fixed_address=True,
        attaches_subscribers=True,
        qos=frozenset({"reliable", "keep_all", "latched"}),
    ),
    opener="robocomp_dsl.runtime.middleware.ice.transport:open_transport",
    configuration="robocomp_dsl.runtime.middleware.ice.configuration:apply",
    tcp_ports="robocomp_dsl.runtime.middleware.ice.addresses:tcp_ports",
    address_problem="robocomp_dsl.runtime.middleware.ice.addresses:address_problem",
    requires=("Ice",),
    install=(
        "on Debian and Ubuntu run: sudo apt-get install python3-zeroc-ice, and see"
        " docs/how-to/ice.md for a virtual environment; elsewhere: pip install 'zeroc-ice<3.8'"
    ),
)
