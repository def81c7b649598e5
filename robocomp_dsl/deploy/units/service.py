"""The unit of one component or program. Pure.

In: a `HostedProcess`. Out: the text of a systemd service (systemd.service(5)), which is the same
whenever the process is the same: rcdeploy compares texts to find out what has changed. systemd
starts, watches, limits and restarts the process as the supervisor does on one machine. The process
has the hash of its unit in its environment, which shows whether it runs what the unit says.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.hosted_process import HOST_PATHS, HostedProcess
from robocomp_dsl.deploy.units.quoting import argument, assignment, command_line, path
from robocomp_dsl.model.deployment import Readiness

REVISION_VARIABLE = "ROBOCOMP_UNIT"
RESTART_DELAY_S = 0.0
"""0 restarts at once; any other delay lasts up to 0.25 s longer, the accuracy of systemd's timers.
The start limit ends a crash loop."""
GRACE_S = 5.0
"""Time between SIGTERM and SIGKILL; the runtime ends a component within 4.5 s."""
MARGIN = 0.5
MIN_MARGIN_S = 0.5
"""systemd waits so much longer than the watchdog of the component, which reports the stack."""
_MARK = '+{"time": %s.%N, "level": "INFO", "message": "'
"""A log line as a format of date(1). It dates the lines of programs, which have no time."""
END_TEXT = "ended: ${EXIT_CODE} ${EXIT_STATUS} (${SERVICE_RESULT})"
"""systemd.exec(5) sets the variables."""
READINESS = "robocomp_dsl.host_tools.wait_until_ready"
_WITHOUT_RESTART = frozenset(
    {
        "ExecReload", "ExecStartPost", "ExecStartPre", "ExecStopPost", "KillMode", "Restart",
        "RestartSec", "RestartForceExitStatus", "SuccessExitStatus", "TimeoutStartSec",
        "TimeoutStopSec",
    }
)  # fmt: skip
"""Settings that systemd takes over while the process runs, as those of the order."""
_WATCHDOG_VARIABLE = "WATCHDOG_USEC"
_CLEAN_SIGNALS = "SIGHUP SIGINT SIGTERM SIGPIPE"
"""Ends that are a success for systemd, and a failure for rcdeploy unless it stops the process."""


def service_unit(hosted: HostedProcess, deployment: str, on_host: frozenset[str]) -> str:
    """The text of the unit. `on_host` are the full names of the processes of the same host.

    Raises `UnitValueError`.
    """
    process = hosted.process
    head = [
        "[Unit]",
        f"Description={path(f'{process.name} of {deployment}')}",
        *_order(hosted, deployment, on_host),
        f"PartOf={names.target_name(deployment)}",
        *_start_limit(process),
    ]
    log = path(f"{hosted.root}/{names.log_file(process.name)}", HOST_PATHS)
    service = [
        "[Service]",
        *_start(hosted, log),
        *_end(process),
        *_environment(hosted),
        *_limits(process),
        f"StandardOutput=append:{log}",
        f"StandardError=append:{log}",
    ]
    return join_sections(head, service, ["[X-RoboComp]", *_identity(hosted)])


def join_sections(head: list[str], service: list[str], identity: list[str]) -> str:
    """The text of a service, with its revision in the environment of the process."""
    lasting = [line for line in service if line.partition("=")[0] not in _WITHOUT_RESTART]
    revision = hashlib.sha256("\n".join([*lasting, *identity]).encode()).hexdigest()[:16]
    service = [*service, f"Environment={REVISION_VARIABLE}={revision}"]
    return "\n".join([*head, "", *service, "", *identity]) + "\n"


def find_revision(text: str) -> str:
    """The revision in the text of a unit, "" if it has none."""
    return _find(text, f"Environment={REVISION_VARIABLE}=")


def find_settings(text: str) -> str:
    """What identifies the settings in the text of a router's unit, "" for other units."""
    return _find(text, "Settings=")


def _find(text: str, key: str) -> str:
    return next((line[len(key) :] for line in text.splitlines() if line.startswith(key)), "")


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


def _start(hosted: HostedProcess, log: str) -> Iterator[str]:
    process = hosted.process
    sends_ready = process.readiness == Readiness()
    yield f"Type={'notify' if sends_ready else 'exec'}"
    yield "NotifyAccess=all"
    yield f"WorkingDirectory={path(str(process.cwd), HOST_PATHS)}"
    yield f"ExecStartPre=-{log_mark('starting')}"
    yield f"ExecStart={_words(_command(process))}"
    if not sends_ready:
        yield f"ExecStartPost={_readiness(hosted, log)}"
    yield f"TimeoutStartSec={process.start_timeout_s:g}"
    if process.watchdog_s:
        margin = 0.0 if process.is_program else max(MARGIN * process.watchdog_s, MIN_MARGIN_S)
        yield f"WatchdogSec={process.watchdog_s + margin:g}"
        # A process that only hangs can still finalize.
        yield "WatchdogSignal=SIGTERM"


def log_mark(text: str) -> str:
    """The command that logs `text`, in which systemd replaces variables."""
    quoted = argument(_MARK).removesuffix('"')
    return f'/usr/bin/env date {quoted}{text}\\"}}"'


def _words(words: Iterable[str]) -> str:
    return command_line(words, HOST_PATHS)


def _command(process: Process) -> tuple[str, ...]:
    """The command line; systemd needs an absolute path, or the program that searches PATH."""
    program, *words = process.argv
    if program.startswith("/"):
        return process.argv
    if "/" in program:
        return f"{process.cwd}/{program.removeprefix('./')}", *words
    return "/usr/bin/env", program, *words


def _readiness(hosted: HostedProcess, log: str) -> str:
    """The command that returns when a program is ready that does not say so itself."""
    readiness = hosted.process.readiness
    if readiness.delay_s:
        return _words(["/usr/bin/env", "sleep", f"{readiness.delay_s:g}"])
    helper = _words([hosted.python, "-m", READINESS])
    if readiness.port:
        return f"{helper} port {readiness.port}"
    return f'{helper} log "{log}" {argument(readiness.pattern)}'


def _end(process: Process) -> Iterator[str]:
    policy = process.restart.policy
    yield f"Restart={'no' if policy == 'never' else policy}"
    yield f"RestartSec={RESTART_DELAY_S:g}"
    if policy == "on-failure":
        yield f"RestartForceExitStatus={_CLEAN_SIGNALS}"
    yield "KillMode=control-group"
    yield f"TimeoutStopSec={GRACE_S:g}"
    yield "SuccessExitStatus=143"
    yield f"ExecStopPost=-{log_mark(END_TEXT)}"


def _environment(hosted: HostedProcess) -> Iterator[str]:
    yield "Environment=PYTHONUNBUFFERED=1"
    yield f"Environment={assignment('ROBOCOMP_HOST', hosted.host)}"
    if hosted.network:
        yield f"Environment={assignment('ROBOCOMP_NETWORK', hosted.network, HOST_PATHS)}"
    for name, value in hosted.process.env:
        if name != _WATCHDOG_VARIABLE:  # systemd sets it
            yield f"Environment={assignment(name, value, HOST_PATHS)}"


def _limits(process: Process) -> Iterator[str]:
    if process.limits.memory_bytes:
        yield f"MemoryMax={process.limits.memory_bytes}"
        yield "MemorySwapMax=0"
    if process.limits.cpu:
        yield f"CPUQuota={process.limits.cpu * 100:g}%"
    if process.limits.cores:
        yield f"CPUAffinity={' '.join(map(str, process.limits.cores))}"
    if process.limits.realtime:
        yield "CPUSchedulingPolicy=fifo"
        yield f"CPUSchedulingPriority={process.limits.realtime}"


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
