"""Supervises the processes of a deployment on one machine, in the foreground.

In: a plan, a lifecycle monitor, a function that receives log records. Out: the outcome, when all
processes have exited. Everything runs in one event loop; only the monitor calls from other threads.
"""

from __future__ import annotations

import asyncio
import contextlib
import time
from asyncio import FIRST_COMPLETED
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.logs import RCDEPLOY, LogRecord
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.deploy.status import ProcessStatus, SimulatedTime
from robocomp_dsl.deploy.supervisor import reaper
from robocomp_dsl.deploy.supervisor.child import ChildProcess
from robocomp_dsl.deploy.supervisor.external_connections import ExternalConnections
from robocomp_dsl.deploy.supervisor.lifecycle_monitor import LifecycleMonitor
from robocomp_dsl.deploy.supervisor.managed_process import KILL_TIMEOUT_S, ManagedProcess
from robocomp_dsl.deploy.supervisor.notify import SOCKET_VARIABLE, NotifySocket
from robocomp_dsl.deploy.supervisor.process_start import ExecutingStarter, ProcessStarter
from robocomp_dsl.deploy.supervisor.process_watch import ProcessWatch, WatchedProcess
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.deploy.supervisor.waiting import wait_any


class Supervisor:
    """Supervises one plan."""

    def __init__(
        self,
        plan: Plan,
        token: str,
        monitor: LifecycleMonitor,
        *,
        emit: Callable[[LogRecord], None],
        changed: Callable[[], None],
        options: Options,
    ) -> None:
        self.plan = plan
        self.token = token
        self._emit = emit
        self.changed = changed
        self.options = options
        self.grace_s = options.grace_s
        self.environment: dict[str, str] = {}
        self.starter: ProcessStarter = ExecutingStarter()
        self.stopping = asyncio.Event()
        self._kill_now = asyncio.Event()
        self._reason, self._code = "", 0
        self._monitor = monitor
        self._notify: NotifySocket | None = None
        self._watches: dict[str, ProcessWatch] = {}
        self._processes = {p.name: ManagedProcess(p, self) for p in plan.processes}
        self._owners = _owners(plan)
        self.external_connections = ExternalConnections(plan.external_connections, self.log)
        self._tasks: set[asyncio.Task[None]] = set()
        self._requests = 0

    def emit(self, record: LogRecord) -> None:
        """Emit a log record; a line of a component may show that it is ready."""
        self._emit(record)
        if watch := self._watches.get(record.component):
            watch.observe(record.text)

    def on_started(self, managed: WatchedProcess, child: ChildProcess) -> None:
        """Watch a process that was started."""
        self._watches[managed.process.name] = ProcessWatch(managed, child)

    def receive_notifications(self, folder: Path) -> None:
        """Listen for sd_notify messages at a socket in `folder`, before `run`."""
        self._notify = NotifySocket(folder, self._on_notification)
        self.environment = {SOCKET_VARIABLE: self._notify.address}

    def _on_notification(self, pid: int, assignments: Mapping[str, str]) -> None:
        for name, process in self._processes.items():
            if process.child is not None and process.child.owns(pid):
                self._watches[name].on_message(assignments)

    def statuses(self) -> list[ProcessStatus]:
        """The status of all components."""
        return [process.status() for process in self._processes.values()]

    def simulated_time(self) -> SimulatedTime | None:
        """The simulated time; None without a simulated clock."""
        return self._monitor.simulated_time()

    def log(self, text: str, level: str = "INFO") -> None:
        """Emit a log record of rcdeploy."""
        self.emit(LogRecord(time.time(), RCDEPLOY, level, text))

    def stop(self, reason: str, code: int = 0) -> None:
        """Stop all processes in order; a second call kills the remaining processes.

        `code` is that of the outcome if no component fails.
        """
        if self.stopping.is_set():
            if not self._kill_now.is_set():
                self.log("second stop request: killing the remaining processes", "WARNING")
            self._kill_now.set()
            return
        self._reason, self._code = reason, code
        self.log(f"stopping: {reason}")
        self.stopping.set()
        for process in self._processes.values():
            process.stop_requested.set()

    async def run(self) -> Outcome:
        """Start all processes and supervise them until all have exited."""
        loop = asyncio.get_running_loop()
        self._monitor.start(lambda *change: _call_in_loop(loop, self._on_state_changed, *change))
        self._all_exited: asyncio.Future[None] = loop.create_future()
        for process in self._processes.values():
            self._launch(process)
        self.external_connections.start()
        duration = loop.create_task(self._stop_after_duration())
        stopping = loop.create_task(self._shut_down())
        try:
            either: list[asyncio.Future[Any]] = [self._all_exited, stopping]
            await asyncio.wait(either, return_when=FIRST_COMPLETED)
            if self._all_exited.done():
                self._all_exited.result()  # raises an internal error of a task
        finally:
            self.stopping.set()
            for task in (duration, stopping, *self._tasks):
                task.cancel()
            self._monitor.close()
            self.starter.close()
            if self._notify:
                self._notify.close()
            await asyncio.to_thread(self.external_connections.close)
            await asyncio.to_thread(self._kill_leftovers)
        return self._outcome()

    def _launch(self, process: ManagedProcess) -> None:
        task = asyncio.get_running_loop().create_task(self._supervise(process))
        self._tasks.add(task)
        task.add_done_callback(self._on_task_done)

    def _on_task_done(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and (error := task.exception()) and not self._all_exited.done():
            self._all_exited.set_exception(error)
        self._end_if_all_exited()

    def _end_if_all_exited(self) -> None:
        """End the run when no component runs and none was stopped or started by request."""
        processes = self._processes.values()
        if self._all_exited.done() or not all(process.done.is_set() for process in processes):
            return
        if self.stopping.is_set() or not (
            self._requests or any(_may_be_started(process) for process in processes)
        ):
            self._all_exited.set_result(None)

    def _on_state_changed(self, name: str, pid: int, state: str) -> None:
        owner = self._owners.get(name, name)
        if (process := self._processes.get(owner)) is None:
            return
        if owner != name:
            if process.child is None or not process.child.owns(pid):
                return
            state = process.member_states.update(name, pid, state)
        process.on_state_changed(pid, state)

    async def _supervise(self, process: ManagedProcess) -> None:
        await process.run([self._processes[name] for name in process.process.after])
        if (
            process.failed
            and not process.stop_requested.is_set()
            and not self.options.keep_going
            and (process.was_ready or not process.on_request)
        ):
            self.stop(f"{process.name} failed")

    @contextlib.contextmanager
    def kept_running(self) -> Iterator[None]:
        """The run does not end while a request is handled, even if no component runs."""
        self._requests += 1
        try:
            yield
        finally:
            self._requests -= 1
            self._end_if_all_exited()

    def is_active(self, name: str) -> bool:
        """Whether a component runs, or will run: it waits for others or for its restart."""
        process = self._processes.get(name)
        return process is not None and not process.done.is_set()

    def is_available(self, name: str) -> bool:
        """Whether dependents of a component can start, or will be able to."""
        return self.is_active(name) or (
            name in self._processes and self._processes[name].is_available
        )

    def status_of(self, name: str) -> ProcessStatus:
        """The status of one component."""
        return self._processes[name].status()

    async def stop_component(self, name: str) -> bool:
        """Stop one component; returns False if it had to be killed."""
        process = self._processes[name]
        process.stop_requested.set()
        exited = await self._terminate(process, self.grace_s)
        await wait_any(process.done, timeout=KILL_TIMEOUT_S)
        return exited

    def start_components(self, names: Iterable[str]) -> None:
        """Start components that are not active, as they are in `plan`; in order of `after`."""
        planned = {process.name: process for process in self.plan.processes}
        self._owners |= _owners(self.plan)
        started = [ManagedProcess(planned[name], self, on_request=True) for name in names]
        self._processes |= {process.name: process for process in started}
        for process in started:
            self._launch(process)

    async def wait_until_ready(self, name: str) -> bool:
        """Wait until a component is ready or has exited; returns whether dependents can start."""
        process = self._processes[name]
        await wait_any(process.ready, process.done, self.stopping)
        return process.is_available

    async def _stop_after_duration(self) -> None:
        """Log when all are ready; with a duration, stop after it."""
        started = time.monotonic()
        for process in self._processes.values():
            await wait_any(process.ready, process.done)
        if not all(process.is_available for process in self._processes.values()):
            return
        elapsed = time.monotonic() - started
        count = len(self._processes)
        subject = f"all {count} components are" if count > 1 else "the component is"
        if count:
            self.log(f"{subject} ready after {elapsed:.2f} s")
        if self.options.duration_s is not None:
            await asyncio.sleep(self.options.duration_s)
            self.stop(f"duration of {self.options.duration_s:g} s is over")

    async def _shut_down(self) -> None:
        """Terminate batch after batch; processes that exceed the grace period are killed."""
        await self.stopping.wait()
        await asyncio.to_thread(self.external_connections.close)
        deadline = time.monotonic() + self.options.stop_timeout_s
        for batch in self.plan.shutdown_batches():
            left = max(0.0, min(self.grace_s, deadline - time.monotonic()))
            members = [self._processes[name] for name in batch if name in self._processes]
            await asyncio.gather(*(self._terminate(member, left) for member in members))
        for process in self._processes.values():
            await wait_any(process.done, timeout=KILL_TIMEOUT_S)

    async def _terminate(self, process: ManagedProcess, grace_s: float) -> bool:
        if exited := await process.terminate(grace_s, self._kill_now):
            return exited
        self.log(f"{process.name} did not exit within {grace_s:g} s and was killed", "WARNING")
        return False

    def _kill_leftovers(self) -> None:
        """Kill processes that components started outside their process groups."""
        for pid in reaper.terminate_all(self.token, 0.0 if self._kill_now.is_set() else 1.0):
            self.log(f"killed process {pid}, which a component left behind", "WARNING")

    def _outcome(self) -> Outcome:
        failed = [process.name for process in self._processes.values() if process.failed]
        if failed:
            return Outcome(1, f"failed: {', '.join(failed)}")
        return Outcome(self._code, self._reason or "all components exited")


def _owners(plan: Plan) -> dict[str, str]:
    """The processes of the components that share one, by component."""
    return {member.name: process.name for process in plan.processes for member in process.members}


def _may_be_started(process: ManagedProcess) -> bool:
    """Whether a user who stopped or started it is expected to start it again."""
    return process.stop_requested.is_set() or (process.on_request and process.failed)


def _call_in_loop(
    loop: asyncio.AbstractEventLoop, call: Callable[..., object], *arguments: object
) -> None:
    if not loop.is_closed():
        loop.call_soon_threadsafe(call, *arguments)
