"""Manages the process of one component: start, readiness, restarts, termination.

In: its `Process`, and the state changes that the lifecycle monitor reports. Out: its status.
"""

from __future__ import annotations

import asyncio
import signal
import time
from dataclasses import replace

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.status import ProcessStatus
from robocomp_dsl.deploy.supervisor import lifecycle_monitor
from robocomp_dsl.deploy.supervisor.child import ChildProcess, describe_exit
from robocomp_dsl.deploy.supervisor.hang_watch import HangWatch
from robocomp_dsl.deploy.supervisor.load_errors import LoadErrors
from robocomp_dsl.deploy.supervisor.member_states import MemberStates
from robocomp_dsl.deploy.supervisor.process_start import process_environment
from robocomp_dsl.deploy.supervisor.restart import RestartDecision, decide_restart
from robocomp_dsl.deploy.supervisor.supervisor_context import SupervisorContext
from robocomp_dsl.deploy.supervisor.waiting import wait_any
from robocomp_dsl.model.deployment import Readiness
from robocomp_dsl.runtime.component.hang_report import HangReport

CLEAN_EXIT_CODES = (0, -signal.SIGTERM, 128 + signal.SIGTERM)
"""Exit codes of a process that exited as requested."""
EXIT_NOT_FOUND = 127
EXIT_TIMEOUT = 124
"""Exit codes as in a shell: the program cannot be started; it was not ready in time."""
KILL_TIMEOUT_S = 5.0
"""Wait at most this long for a process to exit after SIGKILL (it may hang in a driver)."""


class ManagedProcess:
    """The process of one component.

    `done` is set when it will not run again; `failed` is then true after a permanent failure.
    `on_request`: it was started by a request, while the deployment was running.
    """

    def __init__(
        self, process: Process, context: SupervisorContext, *, on_request: bool = False
    ) -> None:
        self.process = process
        self.on_request = on_request
        self.name = process.name
        self.context = context
        self.child: ChildProcess | None = None
        self.ready = asyncio.Event()
        self.done = asyncio.Event()
        self.stop_requested = asyncio.Event()
        self.failed = False
        self.restart_times: list[float] = []
        self._state, self._note = status.WAITING, ""
        self._lifecycle_state = self._failure = ""
        self._started = self.was_ready = self._killed = False
        self._starts_without_ready = 0
        self._early_states: list[tuple[int, str]] = []
        self._hung_child: ChildProcess | None = None
        self._load_errors = LoadErrors()
        self._end_hung: asyncio.Task[None] | None = None
        self.hang: HangReport | None = None
        self.member_states = MemberStates(member.name for member in process.members)

    def status(self) -> ProcessStatus:
        """The current status."""
        restarts, members = len(self.restart_times), ((m.name, "") for m in self.process.members)
        row = ProcessStatus(
            self.name, self._state, restarts=restarts, note=self._note, hang=self.hang,
            members=tuple(members),
        )  # fmt: skip
        if (child := self.child) is None:
            return row
        child.usage.sample()
        up, usage = time.monotonic() - child.started, child.usage
        return replace(
            row, pid=child.pid, up_s=up, cpu=usage.cpu, memory=usage.memory,
            life=self._lifecycle_state, members=self.member_states.as_pairs(),
        )  # fmt: skip

    def on_state_changed(self, pid: int, state: str) -> None:
        """Handle a state change that the monitor reports; events of earlier runs are ignored."""
        child = self.child
        if child is None and self._state == status.STARTING:
            self._early_states.append((pid, state))
        if child is None or self._state == status.STOPPING or not child.owns(pid):
            return
        self._lifecycle_state = state
        if child is self._hung_child or child.has_exited:
            return
        own_condition = self.process.readiness != Readiness()
        if state in lifecycle_monitor.READY_STATES and not own_condition:
            self.ready.set()
        if self.ready.is_set():
            self._transition_to(status.READY if state else status.UNKNOWN, "")
        else:
            self._transition_to(status.STARTING, "")

    def mark_ready(self) -> None:
        """The process has shown that it is ready, by another sign than its lifecycle."""
        child = self.child
        if child is not None and not child.has_exited and self._state == status.STARTING:
            self.ready.set()
            self._transition_to(status.READY, self._note)

    def set_status_text(self, text: str) -> None:
        """Show what the process says of itself."""
        if self.child is not None and self._state in (status.STARTING, status.READY):
            self._transition_to(self._state, text)

    def warn(self, text: str) -> None:
        """Log a warning about the process."""
        self.context.log(f"{self.name} {text}", "WARNING")

    async def fail(self, reason: str) -> None:
        """End the process as failed; its policy decides on a restart."""
        if self.child is None or self._state == status.STOPPING:
            return
        self._killed, self._failure = True, reason
        self.context.log(f"{self.name} {reason}", "ERROR")
        await self.terminate(self.context.grace_s)

    async def run(self, dependencies: list[ManagedProcess]) -> None:
        """Run until it will not run again. All `dependencies` must be ready before it starts."""
        try:
            if await self._wait_for_dependencies(dependencies):
                await self._restart_loop()
        finally:
            self.child = None
            self.done.set()
            self.context.changed()

    async def _wait_for_dependencies(self, dependencies: list[ManagedProcess]) -> bool:
        for dependency in dependencies:
            self._transition_to(status.WAITING, f"for {dependency.name}")
            await wait_any(dependency.ready, dependency.done, self.stop_requested)
            available = dependency.is_available and not dependency.failed
            if self.stop_requested.is_set() or not available:
                reason = f"not started: {dependency.name} was not ready"
                self._transition_to(status.EXITED, reason)
                return False
        return not self.stop_requested.is_set()

    @property
    def is_available(self) -> bool:
        """Whether dependents can start: it is ready, or has exited successfully."""
        if self.done.is_set() and self.stop_requested.is_set():
            return False
        return self.ready.is_set() or (self.done.is_set() and self._started and not self.failed)

    async def _restart_loop(self) -> None:
        """Run the process and restart it as its policy requires."""
        while not self.stop_requested.is_set():
            code = await self._run_once()
            if self.stop_requested.is_set():
                self._on_stopped(code)
                return
            decision = self._decide_restart(code)
            if decision.delay_s is None:
                self._on_final_exit(code, decision.reason)
                return
            message = f"{self.name}: {self._note}, restarting in {decision.delay_s:g} s"
            self.context.log(message, "WARNING")
            self._transition_to(status.BACKOFF, self._note)
            await wait_any(self.stop_requested, timeout=decision.delay_s)
            self.restart_times.append(time.monotonic())
        self._transition_to(status.EXITED, self._note)

    def _decide_restart(self, code: int) -> RestartDecision:
        now, policy = time.monotonic(), self.process.restart
        if code and not self.was_ready and self._load_errors.error:
            self._note = self._load_errors.error
            return RestartDecision(None, "a restart does not help")
        # Starts that time out may be further apart than the window of the policy.
        if self._starts_without_ready > policy.max:
            limit = f"not ready in {self._starts_without_ready} starts"
            return RestartDecision(None, limit)
        return decide_restart(policy, self.restart_times, now, failed=code != 0)

    async def _run_once(self) -> int:
        """Start the process and wait for its exit; returns the exit code."""
        self.ready.clear()
        self._killed, self._failure = False, ""
        self._load_errors = LoadErrors()
        hang_watch = HangWatch(self._on_hang)

        def emit(record: LogRecord) -> None:
            hang_watch.observe(record)
            self._load_errors.observe(record)
            self.context.emit(record)

        self._lifecycle_state = ""
        self._early_states.clear()
        self._transition_to(status.STARTING, "")
        context = self.context
        variables = process_environment(self.process, context.environment, context.token)
        try:
            started = await context.starter.start(self.process, variables, hang_watch.write_end)
        except OSError as error:
            hang_watch.close()
            self._note = f"cannot be started: {error.strerror or error}"
            return EXIT_NOT_FOUND
        self._started = True
        child = self.child = ChildProcess(self.process, started, emit, hang_watch)
        self.context.changed()
        self.context.on_started(self, child)
        for pid, state in self._early_states:
            self.on_state_changed(pid, state)
        if self.stop_requested.is_set():
            await self.terminate(self.context.grace_s)
        await wait_any(child.exited, self.ready, timeout=self.process.start_timeout_s)
        if self.ready.is_set() and not child.has_exited:
            self.was_ready, self._starts_without_ready = True, 0
            up = time.monotonic() - child.started
            self.context.log(f"{self.name} is ready after {up:.2f} s (pid {child.pid})")
        elif not child.has_exited and not self.stop_requested.is_set():
            await self._on_start_timeout()
        await child.exited.wait()
        self.child = None
        if child is self._hung_child and self.hang:
            self._note = self.hang.summary()
            return child.code or EXIT_TIMEOUT
        if self._killed:
            self._note = self._failure or self._note
            return EXIT_TIMEOUT
        self._note = describe_exit(child.code)
        return child.code

    async def _on_start_timeout(self) -> None:
        assert self.child is not None  # noqa: S101 - called while it runs
        state = f" (state: {self._lifecycle_state})" if self._lifecycle_state else ""
        reason = f"not ready within {self.process.start_timeout_s:g} s{state}"
        self.context.log(f"{self.name}: {reason}", "ERROR")
        self._killed = True
        self._starts_without_ready += 1
        await self.terminate(self.context.grace_s)
        self._note = reason

    def _on_hang(self, report: HangReport, ends_itself: bool) -> None:
        """The process hangs: let it finalize, then kill it; its policy decides on a restart."""
        child = self.child
        if child is None or child.has_exited or self._state == status.STOPPING:
            return
        self.hang, self._hung_child = report, child
        self._transition_to(status.HUNG, report.summary())
        if not ends_itself:
            stack = "".join(f"\n{line}" for line in report.stack)
            self.context.log(f"{self.name}: {report.summary()}{stack}", "ERROR")
            child.signal(signal.SIGTERM)
            child.signal(signal.SIGCONT)
        self._end_hung = asyncio.get_running_loop().create_task(self._kill_after_grace(child))

    async def _kill_after_grace(self, child: ChildProcess) -> None:
        await wait_any(child.exited, timeout=self.context.grace_s)
        if not child.exited.is_set():
            child.signal(signal.SIGKILL)

    async def terminate(self, grace_s: float, kill_now: asyncio.Event | None = None) -> bool:
        """Send SIGTERM, and SIGKILL after `grace_s` seconds or when `kill_now` is set.

        Returns False if SIGKILL was needed.
        """
        if self.child is None:
            return True
        child = self.child
        self._transition_to(status.STOPPING, self._note)
        child.signal(signal.SIGTERM)
        child.signal(signal.SIGCONT)  # a stopped process can finalize, too
        await wait_any(child.exited, *filter(None, [kill_now]), timeout=grace_s)
        if child.exited.is_set():
            return True
        child.signal(signal.SIGKILL)
        await wait_any(child.exited, timeout=KILL_TIMEOUT_S)
        return False

    def _on_stopped(self, code: int) -> None:
        if code in CLEAN_EXIT_CODES:
            self._transition_to(status.EXITED, "stopped")
            return
        self.failed = True
        self._transition_to(status.FAILED, f"{describe_exit(code)} while stopping")
        self.context.log(f"{self.name}: {self._note}", "ERROR")

    def _on_final_exit(self, code: int, reason: str) -> None:
        if code == 0:
            self.context.log(f"{self.name} exited")
            self._transition_to(status.EXITED, "")
            return
        self.failed = True
        self._transition_to(status.FAILED, self._note)
        details = f" ({reason})" if reason else ""
        self.context.log(f"{self.name} failed permanently: {self._note}{details}", "ERROR")

    def _transition_to(self, state: str, reason: str) -> None:
        self._state, self._note = state, reason
        self.context.changed()
