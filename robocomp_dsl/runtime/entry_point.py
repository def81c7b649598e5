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
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from robocomp_dsl.runtime.command_line import CONFIG, create_parser, parse_settings
from robocomp_dsl.runtime.component import logs
from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.process_exit import exit_now, exit_with
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import ComponentSpec
from robocomp_dsl.runtime.component.user_errors import TRACEBACK_VARIABLE
from robocomp_dsl.runtime.errors import MiddlewareError, MonitorError, WindowError
from robocomp_dsl.runtime.middleware.registry import UnknownMiddleware
from robocomp_dsl.runtime.parameters import ConfigError

if TYPE_CHECKING:
    from robocomp_dsl.runtime.component.hook_thread import HookThread
    from robocomp_dsl.runtime.component.runner import Runner
    from robocomp_dsl.runtime.component.supervision import Supervision

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
    options, settings = _parse(component.SPEC, argv)
    name = settings.full_name(component.SPEC.name)
    logs.set_up(name, options.log_level, options.log_format)
    window = None
    if component.SPEC.has_window:
        # Loads Qt. The application must exist before the worker, which is a window.
        from robocomp_dsl.runtime.gui.application import WindowApplication  # noqa: PLC0415

        window = WindowApplication(name, component.SPEC.threads)
    runner = _create_runner(component, options, settings, None, window)
    if runner is None:
        return 1
    on_signals(runner.stop)
    runner.start()
    succeeded = window.run(runner) if window else runner.wait()
    code = 0 if succeeded else runner.lifecycle.exit_code or 1
    if runner.abandoned:
        exit_now(code)  # one of its threads hangs
    return code


def create_runner(
    component: type[Component], argv: Sequence[str], supervision: Supervision
) -> Runner | None:
    """What runs a component of a group in one process; None if it cannot start, which is logged.

    Its command line is as in `main`. Raises `SystemExit` for an invalid one, as argparse does.
    """
    options, settings = _parse(component.SPEC, argv)
    if component.SPEC.has_window:
        log.error("a component with a window runs in a process of its own, not in that of a group")
        return None
    return _create_runner(component, options, settings, supervision)


def _parse(
    spec: ComponentSpec, argv: Sequence[str] | None
) -> tuple[argparse.Namespace, RunSettings]:
    parser = create_parser(spec)
    options = parser.parse_args(argv)
    try:
        return options, parse_settings(options, spec)
    except InvalidSetting as error:
        parser.error(str(error))


def _create_runner(
    component: type[Component],
    options: argparse.Namespace,
    settings: RunSettings,
    supervision: Supervision | None,
    hook_thread: HookThread | None = None,
) -> Runner | None:
    if options.traceback:
        os.environ[TRACEBACK_VARIABLE] = "1"
    try:
        config, save_beside = _configuration(options, settings, component.SPEC.name)
        if supervision and supervision.in_group:  # whatever the working folder is later
            config, save_beside = config and config.absolute(), save_beside.absolute()
        params = component.SPEC.parameters.load(config, settings.overrides, save_beside=save_beside)
        settings = replace(settings, config=config)
        if config:
            from robocomp_dsl.runtime.middleware.configured import (  # noqa: PLC0415 - for files
                with_configured_connections,
            )

            settings = with_configured_connections(settings, component.SPEC, config)
    except ConfigError as error:
        print(error, file=sys.stderr)  # noqa: T201 - located findings, not a record
        return None
    # Imported late: errors of the command line and configuration do not need it.
    from robocomp_dsl.runtime.component.runner import Runner  # noqa: PLC0415

    try:
        return Runner(component, params, settings, supervision=supervision, hook_thread=hook_thread)
    except (MiddlewareError, MonitorError, UnknownMiddleware, WindowError) as error:
        log.error("%s", error)  # noqa: TRY400 - the message is all there is to know
        return None


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


def on_signals(stop: Callable[[], None]) -> None:
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
