"""What a middleware can do. Checker, runtime, rcdeploy, documentation and tests ask this.

This module loads quickly: `rcgen check` and the language server import it.
"""

from __future__ import annotations

from dataclasses import dataclass

QOS_ITEMS = ("reliable", "keep_all", "latched", "priority")
"""Items of the quality of service that need support of the middleware.

`depth`, `deadline`, `liveliness` and `thread_priority` are properties of the receiver and available
with every middleware.
"""


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What a middleware can do.

    `between_processes`, `between_hosts`: which components it connects. `services`, `topics`: the
    kinds of ports. `external_peers`: peers may be programs that are no components, named by an
    address. `fixed_address`: the user may choose the address of a served or published port.
    `attaches_subscribers`: its publishers must be given each subscriber (`Publisher.attach`);
    others find their subscribers themselves. `sequence_numbers`: publications carry the number with
    which subscribers count losses. `reports_source`: subscribers learn which port published a
    message. `latches`: it passes latest messages to late subscribers itself; otherwise the
    connection plane does it, between components. `qos`: the items of `QOS_ITEMS` that it honours.
    `max_message_bytes` 0: no limit.
    `valid_names`: a regular expression for names of components and ports, empty: any name.
    `external_port_names`: a regular expression for ports of programs that it can connect with each
    other; empty: it connects none.
    `ros_types_only`: it carries messages and services of ROS only, from `.msg` and `.srv` files.
    `external_ros_types`: components exchange any types, programs that are no components those only.
    `actions`: its programs have actions whose five topics are below the address (actionlib).
    `topic_versions`: subscribers with another version of the interface get the operations that are
    the same; otherwise they get nothing.
    """

    between_processes: bool = True
    between_hosts: bool = False
    services: bool = True
    topics: bool = True
    external_peers: bool = False
    fixed_address: bool = False
    attaches_subscribers: bool = False
    sequence_numbers: bool = False
    reports_source: bool = False
    latches: bool = False
    qos: frozenset[str] = frozenset()
    max_message_bytes: int = 0
    valid_names: str = ""
    external_port_names: str = ""
    ros_types_only: bool = False
    external_ros_types: bool = False
    actions: bool = False
    topic_versions: bool = False


@dataclass(frozen=True, slots=True)
class MiddlewareDescription:
    """One middleware: the object that an entry point of `robocomp_dsl.middleware` names.

    `opener` is the function that opens it, as `module:function`, imported on first use: from a
    `TransportContext` to a `Transport`. `requires` are importable modules without which it cannot
    be opened, and `install` tells how to install them. `configuration` is a function, as
    `module:function`, that adds the connections of RoboComp's configuration keys to the settings of
    a component; see `middleware.configured`. `tcp_ports` is a function, as `module:function`, from
    the address of an own port to the TCP ports of this machine where it listens. `topic_types` is a
    function, as `module:function`, from `timeout` in s to the ROS types of the topics that run
    now, `package/Type` by topic; it raises `MiddlewareError`. `connector` is a
    function without arguments, as `module:function`, that opens an `ExternalConnector`; needed if
    the capabilities have `external_port_names`. `address_problem` is a function, as
    `module:function`, from an address to what is wrong with it, "" for nothing.
    """

    name: str
    summary: str
    capabilities: Capabilities
    opener: str
    requires: tuple[str, ...] = ()
    install: str = ""
    configuration: str = ""
    tcp_ports: str = ""
    topic_types: str = ""
    connector: str = ""
    address_problem: str = ""
