"""The unit of one component or program. Pure.

In: a `HostedProcess`. Out: the text of a systemd service (systemd.service(5)), which is the same
whenever the process is the same: rcdeploy compares texts to find out what has changed. systemd
starts, watches, limits and restarts the process as the supervisor does on one machine.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.hosted_process import HostedProcess
from robocomp_dsl.deploy.units.quoting import NO_PATHS, argument, assignment, command_line, path
from robocomp_dsl.model.deployment import Readiness

RESTART_DELAY_S = 0.1
GRACE_S = 5.0
"""Time between SIGTERM and SIGKILL; the runtime ends a component within 4.5 s."""
MARGIN = 0.5
MIN_MARGIN_S = 0.5
"""systemd waits so much longer than the watchdog of the component, which reports the stack."""
START_MARK = '{"time": %s.%N, "level": "INFO", "message": "starting"}'
"""The log line before each start, a format of date(1); it dates lines that have no time."""
READINESS = "robocomp_dsl.deploy.units.wait_until_ready"
_WATCHDOG_VARIABLE = "WATCHDOG_USEC"
_CLEAN_SIGNALS = "SIGHUP SIGINT SIGTERM SIGPIPE"
"""Ends that are a success for systemd, and a failure for rcdeploy unless it stops the process."""


def service_unit(hosted: HostedProcess, deployment: str, on_host: frozenset[str]) -> str:
    """The text of the unit. `on_host` are the full names of the processes of the same host.

    Raises `UnitValueError`.
    """
    process = hosted.process
    lines = [
        "[Unit]",
        f"Description={path(f'{process.name} of {deployment}')}",
        *_order(hosted, deployment, on_host),
        f"PartOf={names.target_name(deployment)}",
        *_start_limit(process),
        "",
        "[Service]",
        *_start(hosted),
        *_end(process),
        *_environment(hosted),
        *_limits(process),
        f"StandardOutput=append:{hosted.log}",
        f"StandardError=append:{hosted.log}",
        "",
        "[X-RoboComp]",
        *_identity(hosted),
    ]
    return "\n".join(lines) + "\n"


def _order(hosted: HostedProcess, deployment: str, on_host: frozenset[str]) -> Iterator[str]:
    before = [
        names.service_name(deployment, name) for name in hosted.process.after if name in on_host
    ]
    if hosted.network:
        router = names.router_name(deployment)
        yield f"Wants={router}"
        before.insert(0, router)
    if before:
        yield f"After={' '.join(before)}"


def _start_limit(process: Process) -> Iterator[str]:
    if process.restart.policy != "never":
        # The first start counts, too.
        yield f"StartLimitBurst={process.restart.max + 1}"
        yield f"StartLimitIntervalSec={process.restart.window_s:g}"


def _start(hosted: HostedProcess) -> Iterator[str]:
    process = hosted.process
    sends_ready = process.readiness == Readiness()
    yield f"Type={'notify' if sends_ready else 'exec'}"
    yield "NotifyAccess=all"
    yield f"WorkingDirectory={hosted.folder}"
    yield f"ExecStartPre={command_line(['/usr/bin/env', 'date', f'+{START_MARK}'])}"
    yield f"ExecStart={_command(hosted)}"
    if not sends_ready:
        yield f"ExecStartPost={_readiness(hosted)}"
    yield f"TimeoutStartSec={process.start_timeout_s:g}"
    if process.watchdog_s:
        margin = 0.0 if process.is_program else max(MARGIN * process.watchdog_s, MIN_MARGIN_S)
        yield f"WatchdogSec={process.watchdog_s + margin:g}"
        # A process that only hangs can still finalize.
        yield "WatchdogSignal=SIGTERM"


def _command(hosted: HostedProcess) -> str:
    program, *words = hosted.process.argv
    rest = " ".join(argument(word, hosted.paths) for word in words)
    if program.startswith("/"):
        first = argument(program, hosted.paths)
    elif "/" in program:
        first = _in_folder(hosted.folder, program)
    else:
        first = f"/usr/bin/env {argument(program)}"  # searched in PATH, as everywhere else
    return f"{first} {rest}".rstrip()


def _in_folder(folder: str, program: str) -> str:
    """A program given by a path relative to the working folder."""
    quoted = argument(program.removeprefix("./"))
    if quoted.startswith('"'):
        return f'"{folder}/{quoted[1:]}'
    return f"{folder}/{quoted}"


def _readiness(hosted: HostedProcess) -> str:
    """The command that returns when a program is ready that does not say so itself."""
    readiness = hosted.process.readiness
    if readiness.delay_s:
        return command_line(["/usr/bin/env", "sleep", f"{readiness.delay_s:g}"])
    if readiness.port:
        words = ["port", str(readiness.port)]
        return f"{hosted.python} -m {READINESS} {command_line(words)}"
    pattern = argument(readiness.pattern, NO_PATHS)
    return f"{hosted.python} -m {READINESS} log {hosted.log} {pattern}"


def _end(process: Process) -> Iterator[str]:
    policy = process.restart.policy
    yield f"Restart={'no' if policy == 'never' else policy}"
    yield f"RestartSec={RESTART_DELAY_S:g}"
    if policy == "on-failure":
        yield f"RestartForceExitStatus={_CLEAN_SIGNALS}"
    yield "KillMode=control-group"
    yield f"TimeoutStopSec={GRACE_S:g}"
    yield "SuccessExitStatus=143"


def _environment(hosted: HostedProcess) -> Iterator[str]:
    yield "Environment=PYTHONUNBUFFERED=1"
    yield f"Environment={assignment('ROBOCOMP_HOST', hosted.host)}"
    if hosted.network:
        yield f"Environment=ROBOCOMP_NETWORK={hosted.network}"
    for name, value in hosted.process.env:
        if name != _WATCHDOG_VARIABLE:  # systemd sets it
            yield f"Environment={assignment(name, value, hosted.paths)}"


def _limits(process: Process) -> Iterator[str]:
    if process.limits.memory_bytes:
        yield f"MemoryMax={process.limits.memory_bytes}"
        yield "MemorySwapMax=0"
    if process.limits.cpu:
        yield f"CPUQuota={process.limits.cpu * 100:g}%"


def _identity(hosted: HostedProcess) -> Iterator[str]:
    """What the process is made of; systemd ignores this section."""
    yield f"Component={path(hosted.process.name)}"
    for name, value in (
        ("Tree", hosted.tree),
        ("Environment", hosted.environment),
        ("Certificate", hosted.certificate),
    ):
        if value:
            yield f"{name}={value}"
