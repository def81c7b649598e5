"""The first process of a container: runs one program, and shows whether it is ready and alive.

    python3 -m robocomp_dsl.deploy.container.init [--watchdog S] [--ready-log REGEX |
        --ready-port N | --ready-after S] [--cores LIST] [--realtime N] [--network FOLDER] --
        PROGRAM …

In: the program. Out: its output and exit code, and two files in /run/robocomp for probes: `ready`
from the moment when it is ready, `alive` as long as it does not hang. A component reports both by
sd_notify(3). Signals are passed on, and processes that it leaves behind are reaped. `--network`:
settings and keys in FOLDER are copied to where only this user reads them. Standard library only.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import select
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.container.notifications import Notifications

STATE_FOLDER = Path("/run/robocomp")
READY, ALIVE = "ready", "alive"
NETWORK_FILE = "network.json"
EXIT_HANG = 124
WATCHDOG_MARGIN = 1.5
"""The watchdog of the component itself is first: it reports the stack."""
PERIOD_S = 0.1
KILL_S = 5.0
_SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGUSR1, signal.SIGUSR2)
_HOSTS = ("127.0.0.1", "::1")


class Init:
    """One program in a container."""

    def __init__(self, options: argparse.Namespace, state: Path) -> None:
        self._options = options
        self._state = state
        self._pattern = re.compile(options.ready_log) if options.ready_log else None
        self._own_condition = bool(options.ready_log or options.ready_port or options.ready_after)
        self._is_ready = False
        self._fed_at = 0.0
        self._stops_at = 0.0
        self._output = b""
        for name in (READY, ALIVE):
            (state / name).unlink(missing_ok=True)
        self._notifications = Notifications(state / "notify")
        environment = {**os.environ, "NOTIFY_SOCKET": self._notifications.address}
        if options.watchdog:
            environment["WATCHDOG_USEC"] = str(round(options.watchdog * 1e6))
        if options.network:
            settings = copy_network(Path(options.network), state / "network")
            environment["ROBOCOMP_NETWORK"] = str(settings)
        self._started = time.monotonic()
        self._process = subprocess.Popen(  # noqa: S603 - the program of the container
            options.program,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE if self._pattern else None,
            start_new_session=True,
        )
        (state / ALIVE).touch()

    def run(self) -> int:
        """Supervise the program until it has exited; its exit code, 128 + N after signal N."""
        for number in _SIGNALS:
            signal.signal(number, self._pass_on)
        try:
            while self._process.poll() is None:
                self._wait()
                self._check()
                _reap_others(self._process.pid)
        finally:
            for name in (READY, ALIVE):
                (self._state / name).unlink(missing_ok=True)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
            self._notifications.close()
        while self._pattern and self._read_output():
            pass
        code = self._process.returncode
        return EXIT_HANG if self._stops_at else code if code >= 0 else 128 - code

    def _pass_on(self, number: int, _frame: object) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, number)

    def _wait(self) -> None:
        sources: list[Any] = [self._notifications]
        if self._process.stdout and not self._process.stdout.closed:
            sources.append(self._process.stdout)
        readable = select.select(sources, [], [], PERIOD_S)[0]
        if self._notifications in readable:
            self._on_message(self._notifications.read())
        if self._process.stdout in readable:
            self._read_output()

    def _on_message(self, assignments: dict[str, str]) -> None:
        if assignments.get("READY") == "1" and not self._own_condition:
            self._set_ready()
        if assignments.get("WATCHDOG") == "1":
            self._fed_at = time.monotonic()

    def _read_output(self) -> bool:
        """Pass on what the program prints, and look for the line that shows that it is ready."""
        assert self._process.stdout is not None  # noqa: S101 - a pipe
        if self._process.stdout.closed:
            return False
        data = os.read(self._process.stdout.fileno(), 1 << 16)
        if not data:
            self._process.stdout.close()
            return False
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()
        *lines, self._output = (self._output + data).split(b"\n")
        if self._pattern and any(self._pattern.search(x.decode(errors="replace")) for x in lines):
            self._set_ready()
        return True

    def _check(self) -> None:
        now = time.monotonic()
        options = self._options
        if not self._is_ready and (
            (options.ready_after and now - self._started >= options.ready_after)
            or (options.ready_port and _answers(options.ready_port))
        ):
            self._set_ready()
        limit = options.watchdog * WATCHDOG_MARGIN
        if limit and self._fed_at and now - self._fed_at > limit and not self._stops_at:
            print(f"hangs: no WATCHDOG=1 within {limit:g} s", file=sys.stderr, flush=True)  # noqa: T201 - the log of the container
            (self._state / ALIVE).unlink(missing_ok=True)
            self._pass_on(signal.SIGTERM, None)
            self._stops_at = now + KILL_S
        elif self._stops_at and now >= self._stops_at:
            self._pass_on(signal.SIGKILL, None)

    def _set_ready(self) -> None:
        if not self._is_ready:
            self._is_ready = True
            self._fed_at = time.monotonic()
            (self._state / READY).touch()


def copy_network(source: Path, target: Path) -> Path:
    """Copy the files of `source` to `target`, readable for this user only; the settings there."""
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(mode=0o700)
    for path in sorted(source.iterdir()):
        if path.is_file():
            descriptor = os.open(target / path.name, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
            with open(descriptor, "wb") as stream:  # noqa: PTH123 - a descriptor
                stream.write(path.read_bytes())
    return target / NETWORK_FILE


def _reap_others(program: int) -> None:
    """Reap processes that the program left behind: they become children of the first process."""
    with contextlib.suppress(ChildProcessError):
        while found := os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT):
            if found.si_pid == program:
                return
            os.waitpid(found.si_pid, 0)


def _answers(port: int) -> bool:
    for host in _HOSTS:
        with contextlib.suppress(OSError), socket.create_connection((host, port), PERIOD_S):
            return True
    return False


def _schedule(options: argparse.Namespace) -> None:
    if options.cores:
        os.sched_setaffinity(0, {int(core) for core in options.cores.split(",")})
    if options.realtime:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(options.realtime))


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    """The options of the command line."""
    parser = argparse.ArgumentParser(prog="init", description=__doc__, allow_abbrev=False)
    parser.add_argument("--watchdog", type=float, default=0.0)
    parser.add_argument("--ready-log", default="")
    parser.add_argument("--ready-port", type=int, default=0)
    parser.add_argument("--ready-after", type=float, default=0.0)
    parser.add_argument("--cores", default="")
    parser.add_argument("--realtime", type=int, default=0)
    parser.add_argument("--network", default="")
    parser.add_argument("--state", type=Path, default=STATE_FOLDER)
    parser.add_argument("program", nargs="+")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str]) -> int:
    """Run the program of the command line; the exit code."""
    options = parse(arguments)
    try:
        _schedule(options)
        init = Init(options, options.state)
    except OSError as error:
        print(f"{' '.join(options.program)} cannot be started: {error}", file=sys.stderr)  # noqa: T201
        return 127
    return init.run()


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
