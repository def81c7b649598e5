"""The command line of a component: its options, and the settings that they mean.

In: the specification of a component and a command line. Out: `RunSettings`.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from robocomp_dsl import __version__
from robocomp_dsl.runtime.component import logs
from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.qos_settings import parse_qos
from robocomp_dsl.runtime.component.settings import (
    RunSettings,
    parse_addresses,
    parse_connections,
    parse_external,
    parse_middlewares,
    parse_name,
    parse_prefix,
    parse_remaps,
    parse_transport_settings,
    with_defaults,
)
from robocomp_dsl.runtime.component.spec import ComponentSpec
from robocomp_dsl.runtime.component.user_errors import TRACEBACK_VARIABLE
from robocomp_dsl.runtime.parameters.shown import describe_parameters
from robocomp_dsl.runtime.time.clock_settings import ClockSettings, parse_clock

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors

CONFIG = Path("etc/config.yaml")
MAX_WATCHDOG_S = 86_400.0


def create_parser(spec: ComponentSpec) -> argparse.ArgumentParser:
    """The parser of the options of a component."""
    parser = argparse.ArgumentParser(
        description=f"Run the component {spec.name}.",
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="\n".join(_parameter_help(spec)),
    )
    add = parser.add_argument
    add(
        "--config",
        metavar="FILE",
        type=Path,
        help=f"YAML or TOML file (default: {CONFIG} if it exists)",
    )
    add("--context", metavar="C", default="", help="use the configuration files of this context")
    add("--config-name", metavar="FILE", default="", help="name of a configuration to search for")
    add("--verbose-search", action="store_true", help="log every path that is searched")
    add("--set", metavar="KEY=VALUE", action="append", default=[], help="set a parameter")
    add("--name", default="", help=f"name of this instance ({spec.name})")
    add("--prefix", default="", help="namespace of this instance and its peers, such as left")
    add(
        "--middleware",
        metavar="[PORT=]M",
        action="append",
        default=[],
        help=f"middleware of all ports, or of one ({spec.middleware})",
    )
    add(
        "--domain",
        default=os.environ.get("ROBOCOMP_DOMAIN") or "default",
        help="components connect only within one domain (ROBOCOMP_DOMAIN or default)",
    )
    add(
        "--connect",
        metavar="PORT=PEER",
        action="append",
        default=[],
        help="connect a port to COMPONENT, COMPONENT.PORT, or a program at MIDDLEWARE:ADDRESS",
    )
    add(
        "--address",
        metavar="PORT=M:ADDRESS",
        action="append",
        default=[],
        help="address of an own port for programs that are no components",
    )
    add(
        "--transport",
        metavar="M.KEY=VALUE",
        action="append",
        default=[],
        help="setting of a middleware",
    )
    add("--monitors", metavar="JSON", default="", help="monitors of connections, or @FILE")
    add("--remap", metavar="PORT=NAME", action="append", default=[], help="rename a port")
    add(
        "--qos",
        metavar="PORT[/PEER]=QOS",
        action="append",
        default=[],
        help="reliable|best_effort,keep_all,depth=N,latched,priority=high,deadline=MS,"
        "liveliness=MS,thread_priority=N",
    )
    add(
        "--clock",
        metavar="CLOCK",
        type=parse_clock,
        default=ClockSettings(),
        help="wall (default), or sim|lockstep,from=COMPONENT for its simulated clock",
    )
    add(
        "--listen-port",
        metavar="N",
        type=int,
        default=0,
        help="also listen on this TCP port of loopback",
    )
    add(
        "--watchdog",
        metavar="S",
        type=float,
        help=f"end as failed if compute or a handler hangs for S seconds; 0: off"
        f" ({spec.watchdog:g})",
    )
    add(
        "--log-level",
        choices=logs.LEVELS,
        default=_default_log_level(),
        help="(info, or LOG_LEVEL)",
    )
    add(
        "--traceback",
        action="store_true",
        help=f"log the traceback of each error in user code (or set {TRACEBACK_VARIABLE}=1)",
    )
    add("--log-format", choices=("text", "json"), default="text")
    add("--version", action="version", version=f"{spec.name}, robocomp_dsl {__version__}")
    return parser


def _parameter_help(spec: ComponentSpec) -> Iterator[str]:
    if spec.parameters.SCHEMA:
        yield "parameters (in the configuration file, or with --set):"
        yield from describe_parameters(spec.parameters.SCHEMA)


def _default_log_level() -> str:
    level = os.environ.get("LOG_LEVEL", "").lower()
    return level if level in logs.LEVELS else "info"


def parse_settings(options: argparse.Namespace, spec: ComponentSpec) -> RunSettings:
    """The settings of the command line. Raises `InvalidSetting`."""
    internal, external = parse_external(with_defaults(spec.connections, options.connect))
    connections = parse_connections(internal)
    qos, peer_qos = parse_qos(with_defaults(spec.qualities, options.qos))
    remaps = parse_remaps(options.remap)
    addresses = parse_addresses(with_defaults(spec.addresses, options.address))
    middleware, port_middlewares = parse_middlewares(options.middleware)
    ports = list(_ports(spec))
    monitors = _monitors(options.monitors)
    own = (*(port for _, port in addresses), *(connection.port for connection in monitors))
    for name in (*connections, *external, *qos, *peer_qos, *remaps, *port_middlewares, *own):
        if name not in ports:
            known = f"its ports: {', '.join(ports)}" if ports else "it has no ports"
            raise InvalidSetting(f"{spec.name} has no port `{name}`; {known}")
    _check_port_names(spec, remaps)
    if options.config and (options.context or options.config_name):
        raise InvalidSetting(
            "--config is an exact path; it cannot be combined with --context or --config-name"
        )
    if not 0 <= options.listen_port <= 65535:
        raise InvalidSetting(f"{options.listen_port} is not a port number (0 to 65535)")
    if options.watchdog is not None and not 0 <= options.watchdog <= MAX_WATCHDOG_S:
        raise InvalidSetting(f"--watchdog {options.watchdog:g} is not a time from 0 to a day, in s")
    return RunSettings(
        name=parse_name(options.name, "name") if options.name else "",
        prefix=parse_prefix(options.prefix),
        domain=options.domain,
        middleware=middleware,
        port_middlewares=port_middlewares,
        external=external,
        addresses=addresses,
        transport_settings=parse_transport_settings(options.transport),
        config=options.config or (CONFIG if CONFIG.is_file() else None),
        overrides=tuple(options.set),
        connections=connections,
        qos=qos,
        peer_qos=peer_qos,
        remaps=remaps,
        listen_port=options.listen_port,
        clock=options.clock,
        watchdog=options.watchdog,
        monitors=monitors,
    )


def _monitors(text: str) -> tuple[ConnectionMonitors, ...]:
    if not text:
        return ()
    from robocomp_dsl.runtime.connection.parse_monitors import parse_monitors  # noqa: PLC0415

    return parse_monitors(text)


def _check_port_names(spec: ComponentSpec, remaps: Mapping[str, str]) -> None:
    """Check that served and published ports have distinct names. Raises `InvalidSetting`."""
    names = {"Component": "Component"}
    for own in [implement.name for implement in spec.implements] + [
        publish.name for publish in spec.publishes
    ]:
        name = remaps.get(own, own)
        other = names.setdefault(name, own)
        if other != own and (own in remaps or other in remaps):
            raise InvalidSetting(f"`{other}` and `{own}` would both be named `{name}`")


def _ports(spec: ComponentSpec) -> Iterator[str]:
    for ports in (spec.implements, spec.requires, spec.publishes, spec.subscribes):
        yield from (port.name for port in ports)
