"""The program of a component: its options, its signals, its exit code.

In: the user's class and a command line. Out: 0 when the component ended in order, 1 when it could
not start or failed, 2 when the command line cannot be understood.
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

from robocomp_dsl import __version__
from robocomp_dsl.runtime import logs
from robocomp_dsl.runtime.clock_settings import ClockSettings, parse_clock
from robocomp_dsl.runtime.component import Component
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware import UnknownMiddleware
from robocomp_dsl.runtime.parameters import ConfigError, Parameters
from robocomp_dsl.runtime.parameters.shown import lines
from robocomp_dsl.runtime.settings import (
    RunSettings,
    WrongSetting,
    parse_name,
    parse_prefix,
    parse_qualities,
    parse_remaps,
    parse_wires,
)
from robocomp_dsl.runtime.spec import ComponentSpec

CONFIG = Path("etc/config.yaml")
log = logging.getLogger("robocomp")


def main(component: type[Component], argv: Sequence[str] | None = None) -> int:
    """Run `component` until it ends or is told to; returns the exit code of the program."""
    parser = _parser(component.SPEC)
    said = parser.parse_args(argv)
    try:
        settings = _settings(said, component.SPEC)
    except WrongSetting as error:
        parser.error(str(error))
    name = settings.whole_name(component.SPEC.name)
    logs.set_up(name, said.log_level, said.log_format)
    try:
        config, keeps = _configuration(said, settings, component.SPEC.name)
        params = component.SPEC.parameters.load(config, settings.overrides, keeps=keeps)
        settings = replace(settings, config=config)
    except ConfigError as error:
        print(error, file=sys.stderr)  # noqa: T201 - located findings, not a record
        return 1
    return _run(component, params, settings)


def _configuration(
    said: argparse.Namespace, settings: RunSettings, component: str
) -> tuple[Path | None, Path]:
    """The file, and the one beside which live values are kept. Raises `ConfigError`."""
    path, keeps = settings.config, settings.config or CONFIG
    if said.verbose_search and not (said.context or said.file):
        log.info("configuration %s; neither --context nor --from asks for a search", path or "none")
    if said.context or said.file:
        from robocomp_dsl.runtime.config.start import Asked, found  # noqa: PLC0415 - seldom

        whole = settings.whole_name(component)
        names = tuple(dict.fromkeys((whole, settings.name or component, component)))
        asked = Asked(said.context, said.file, names)
        path, keeps = found(asked, CONFIG, verbose=said.verbose_search)
    elif not _can_keep(keeps):
        from robocomp_dsl.runtime.config.start import keep_of  # noqa: PLC0415 - seldom

        keeps = keep_of(keeps, component)
    # Copies of a component that share a configuration do not share the values they keep.
    return path, keeps.parent / settings.prefix / keeps.name


def _can_keep(config: Path) -> bool:
    """Whether a file beside it can be written, after its folder was made if need be."""
    above = (config.parent, *config.absolute().parents)
    there = next(one for one in above if os.access(one, os.F_OK))
    return os.access(there, os.W_OK | os.X_OK)


def _run(component: type[Component], params: Parameters, settings: RunSettings) -> int:
    # Loaded late: a wrong command line or configuration is told without it.
    from robocomp_dsl.runtime.runner import Runner  # noqa: PLC0415

    try:
        runner = Runner(component, params, settings)
    except (MiddlewareError, UnknownMiddleware) as error:
        log.error("%s", error)  # noqa: TRY400 - the message is all there is to know
        return 1
    _on_signals(runner.stop)
    runner.start()
    return 0 if runner.wait() else 1


def _on_signals(stop: Callable[[], None]) -> None:
    """Call `stop` on SIGTERM and SIGINT, whichever thread the system hands them to.

    Python runs its handlers in the main thread only, which can sleep through a signal; the byte in
    the pipe is written by the handler in C.
    """
    heard, told = os.pipe()
    os.set_blocking(told, False)
    signal.set_wakeup_fd(told, warn_on_full_buffer=False)
    for one in (signal.SIGTERM, signal.SIGINT):
        signal.signal(one, lambda *_: None)

    def listen() -> None:
        os.read(heard, 1)
        stop()

    threading.Thread(target=listen, name="signals", daemon=True).start()


def _parser(spec: ComponentSpec) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        description=f"Run the component {spec.name}.",
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="\n".join(_parameters(spec)),
    )
    add = parser.add_argument
    add("--config", metavar="FILE", type=Path, help=f"YAML or TOML ({CONFIG} if it is there)")
    add("--context", metavar="C", default="", help="configured by the files of this context")
    add("--from", metavar="FILE", dest="file", default="", help="a configuration to search for")
    add("--verbose-search", action="store_true", help="tell each place that was searched")
    add("--set", metavar="KEY=VALUE", action="append", default=[], help="set a parameter")
    add("--name", default="", help=f"name of this instance ({spec.name})")
    add("--prefix", default="", help="before the names of this instance and its peers, as in left")
    add("--middleware", metavar="M", default="", help=f"carries all ports ({spec.middleware})")
    add(
        "--domain",
        default=os.environ.get("ROBOCOMP_DOMAIN") or "default",
        help="only components of the same domain see each other (ROBOCOMP_DOMAIN or default)",
    )
    add("--connect", metavar="PORT=COMPONENT", action="append", default=[], help="wire a port")
    add("--remap", metavar="PORT=NAME", action="append", default=[], help="rename a port")
    add(
        "--qos",
        metavar="PORT=QOS",
        action="append",
        default=[],
        help="reliable|best_effort,depth=N,priority=high,deadline=MS",
    )
    add(
        "--clock",
        metavar="CLOCK",
        type=parse_clock,
        default=ClockSettings(),
        help="wall, or sim|lockstep,from=COMPONENT: the time that it publishes (wall)",
    )
    add("--listen-port", metavar="N", type=int, default=0, help="listen there on loopback, too")
    add("--log-level", choices=logs.LEVELS, default=_level(), help="(info, or LOG_LEVEL)")
    add("--log-format", choices=("text", "json"), default="text")
    add("--version", action="version", version=f"{spec.name}, robocomp_dsl {__version__}")
    return parser


def _parameters(spec: ComponentSpec) -> Iterator[str]:
    if spec.parameters.SCHEMA:
        yield "parameters (in the configuration, or after --set):"
        yield from lines(spec.parameters.SCHEMA)


def _level() -> str:
    said = os.environ.get("LOG_LEVEL", "").lower()
    return said if said in logs.LEVELS else "info"


def _settings(said: argparse.Namespace, spec: ComponentSpec) -> RunSettings:
    """What was said, checked. Raises `WrongSetting`."""
    wires, qualities = parse_wires(said.connect), parse_qualities(said.qos)
    remaps = parse_remaps(said.remap)
    ports = list(_ports(spec))
    for name in (*wires, *qualities, *remaps):
        if name not in ports:
            known = f"it has {', '.join(ports)}" if ports else "it has none"
            raise WrongSetting(f"{spec.name} has no port `{name}`; {known}")
    _check_seen(spec, remaps)
    if said.config and (said.context or said.file):
        raise WrongSetting("--config is an exact path; there is nothing left to search for")
    if not 0 <= said.listen_port <= 65535:
        raise WrongSetting(f"{said.listen_port} is no port number")
    return RunSettings(
        name=parse_name(said.name, "name") if said.name else "",
        prefix=parse_prefix(said.prefix),
        domain=said.domain,
        middleware=said.middleware,
        config=said.config or (CONFIG if CONFIG.is_file() else None),
        overrides=tuple(said.set),
        wires=wires,
        qualities=qualities,
        remaps=remaps,
        listen_port=said.listen_port,
        clock=said.clock,
    )


def _check_seen(spec: ComponentSpec, remaps: Mapping[str, str]) -> None:
    """Two ports that others see must not have one name. Raises `WrongSetting`."""
    seen = {"Component": "Component"}
    for own in [one.name for one in spec.implements] + [one.name for one in spec.publishes]:
        name = remaps.get(own, own)
        other = seen.setdefault(name, own)
        if other != own and (own in remaps or other in remaps):
            raise WrongSetting(f"`{other}` and `{own}` would both be called `{name}`")


def _ports(spec: ComponentSpec) -> Iterator[str]:
    for ports in (spec.implements, spec.requires, spec.publishes, spec.subscribes):
        yield from (port.name for port in ports)
