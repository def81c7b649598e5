"""Main function of a component: command line, signals, exit code.

In: the user's class and a command line. Out: 0 when the component stopped normally, 1 when it could
not start or failed, 2 for an invalid command line.
"""

from __future__ import annotations

import argparse
import logging
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from robocomp_dsl import __version__
from robocomp_dsl.runtime.component import logs
from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.process_exit import exit_now, exit_with
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
from robocomp_dsl.runtime.errors import MiddlewareError, MonitorError
from robocomp_dsl.runtime.middleware.registry import UnknownMiddleware
from robocomp_dsl.runtime.parameters import ConfigError, Parameters
from robocomp_dsl.runtime.parameters.shown import describe_parameters
from robocomp_dsl.runtime.time.clock_settings import ClockSettings, parse_clock

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors

CONFIG = Path("etc/config.yaml")
MAX_WATCHDOG_S = 86_400.0
log = logging.getLogger("robocomp")


def main(component: type[Component], argv: Sequence[str] | None = None) -> int:
    """Run `component` until it stops or is stopped; returns the exit code of the process.

    Called by a program itself, it also sets how the process ends: see `process_exit`.
    """
    code = _main(component, argv)
    if sys._getframe(1).f_globals.get("__name__") == "__main__":
        exit_with(code)
    return code


def _main(component: type[Component], argv: Sequence[str] | None) -> int:
    parser = _parser(component.SPEC)
    options = parser.parse_args(argv)
    try:
        settings = _settings(options, component.SPEC)
    except InvalidSetting as error:
        parser.error(str(error))
    name = settings.full_name(component.SPEC.name)
    logs.set_up(name, options.log_level, options.log_format)
    if options.traceback:
        os.environ[TRACEBACK_VARIABLE] = "1"
    try:
        config, save_beside = _configuration(options, settings, component.SPEC.name)
        params = component.SPEC.parameters.load(config, settings.overrides, save_beside=save_beside)
        settings = replace(settings, config=config)
        if config:
            from robocomp_dsl.runtime.middleware.configured import (  # noqa: PLC0415 - for files
                with_configured_connections,
            )

            settings = with_configured_connections(settings, component.SPEC, config)
    except ConfigError as error:
        print(error, file=sys.stderr)  # noqa: T201 - located findings, not a record
        return 1
    return _run(component, params, settings)


def _configuration(
    options: argparse.Namespace, settings: RunSettings, component: str
) -> tuple[Path | None, Path]:
    """The configuration, and the path beside which live values are saved. Raises `ConfigError`."""
    path, save_beside = settings.config, settings.config or CONFIG
    if options.verbose_search and not (options.context or options.config_name):
        log.info(
            "configuration %s; no search: neither --context nor --config-name is set",
            path or "none",
        )
    if options.context or options.config_name:
        from robocomp_dsl.runtime.config.startup import (  # noqa: PLC0415 - seldom needed
            ConfigRequest,
            find_config,
        )

        full = settings.full_name(component)
        names = tuple(dict.fromkeys((full, settings.name or component, component)))
        request = ConfigRequest(options.context, options.config_name, names)
        path, save_beside = find_config(request, CONFIG, verbose=options.verbose_search)
    elif not _can_save_beside(save_beside):
        from robocomp_dsl.runtime.config.startup import fallback_save_path  # noqa: PLC0415 - seldom

        save_beside = fallback_save_path(save_beside, component)
    # Copies of a component that share a configuration have separate saved values.
    return path, save_beside.parent / settings.prefix / save_beside.name


def _can_save_beside(config: Path) -> bool:
    """Whether a file in the folder of `config` can be written; a missing folder can be created."""
    above = (config.parent, *config.absolute().parents)
    existing = next(folder for folder in above if os.access(folder, os.F_OK))
    return os.access(existing, os.W_OK | os.X_OK)


def _run(component: type[Component], params: Parameters, settings: RunSettings) -> int:
    # Imported late: errors of the command line and configuration do not need it.
    from robocomp_dsl.runtime.component.runner import Runner  # noqa: PLC0415

    try:
        runner = Runner(component, params, settings)
    except (MiddlewareError, MonitorError, UnknownMiddleware) as error:
        log.error("%s", error)  # noqa: TRY400 - the message is all there is to know
        return 1
    _on_signals(runner.stop)
    runner.start()
    succeeded = runner.wait()
    if runner.abandoned:
        exit_now(1)  # one of its threads hangs
    return 0 if succeeded else 1


def _on_signals(stop: Callable[[], None]) -> None:
    """Call `stop` on SIGTERM and SIGINT, whichever thread receives the signal.

    Python runs its handlers in the main thread only, which may be blocked; the wake-up pipe is
    written by the handler in C.
    """
    read_end, write_end = os.pipe()
    os.set_blocking(write_end, False)
    signal.set_wakeup_fd(write_end, warn_on_full_buffer=False)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: None)

    def listen() -> None:
        os.read(read_end, 1)
        stop()

    threading.Thread(target=listen, name="signals", daemon=True).start()


def _parser(spec: ComponentSpec) -> argparse.ArgumentParser:
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


def _settings(options: argparse.Namespace, spec: ComponentSpec) -> RunSettings:
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
