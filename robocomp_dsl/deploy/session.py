"""Runs a deployment in the foreground: supervisor, reaper, control socket and signals.

In: a plan, a lock on its name, a lifecycle monitor, a display. Out: the outcome. All processes of
the deployment have exited when it returns.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import time
from collections.abc import Callable
from dataclasses import asdict
from functools import partial

from robocomp_dsl.deploy import instances
from robocomp_dsl.deploy.control import ControlServer, LogJournal
from robocomp_dsl.deploy.log_store import LogStore
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.deploy.status import ProcessStatus
from robocomp_dsl.deploy.supervisor.fork_server import ForkServer, is_forkable
from robocomp_dsl.deploy.supervisor.lifecycle_monitor import LifecycleMonitor
from robocomp_dsl.deploy.supervisor.reaper import DEPLOYMENT_VARIABLE
from robocomp_dsl.deploy.supervisor.reaper_process import ReaperProcess
from robocomp_dsl.deploy.supervisor.requests import ComponentRequests, Replan
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.deploy.supervisor.supervisor import Supervisor

EXIT_BROKEN_PIPE = 141
"""As in a shell: 128 + SIGPIPE."""
_SIGNALS = {
    signal.SIGINT: "Ctrl-C",
    signal.SIGTERM: "SIGTERM",
    signal.SIGHUP: "the terminal was closed",
}


class Display:
    """Shows the output of a session; this base class shows nothing."""

    def record(self, record: LogRecord) -> None:
        """Show a line of output."""

    def attach(
        self,
        statuses: Callable[[], list[ProcessStatus]],
        abort: Callable[[str], object],
        log: Callable[[str], object],
    ) -> None:
        """Receive functions to get the status, to stop the run as failed, and to log a warning.

        They can be called from any thread.
        """

    def changed(self) -> None:
        """A status has changed."""


def run(
    plan: Plan,
    lock: instances.InstanceLock,
    monitor: LifecycleMonitor,
    display: Display,
    options: Options,
    replan: Replan | None = None,
    store: LogStore | None = None,
) -> Outcome:
    """Run `plan` in the foreground until it ends or is stopped.

    `store` keeps the logs. `replan` reads the description again for components that are started on
    request.
    """
    journal = LogJournal()

    def emit(record: LogRecord) -> None:
        record = journal.add(record)
        display.record(record)
        if store:
            store.record(record)

    token = f"{plan.domain}.{os.getpid()}"
    supervisor = Supervisor(
        plan, token, monitor, emit=emit, changed=display.changed, options=options
    )
    outcome = Outcome(1, "rcdeploy itself failed")
    try:
        reaper = ReaperProcess(token, options.grace_s)
        try:
            outcome = asyncio.run(_run(supervisor, journal, lock, display, replan, store, reaper))
        except BaseException:
            reaper.close(clean=False)
            raise
        reaper.close(clean=True)
    finally:
        if store:
            store.close(outcome.code, outcome.reason)
    return outcome


async def _run(
    supervisor: Supervisor,
    journal: LogJournal,
    lock: instances.InstanceLock,
    display: Display,
    replan: Replan | None,
    store: LogStore | None,
    reaper: ReaperProcess,
) -> Outcome:
    loop = asyncio.get_running_loop()
    for number, reason in _SIGNALS.items():
        loop.add_signal_handler(number, supervisor.stop, reason)
    plan = supervisor.plan
    requests = ComponentRequests(supervisor, replan)
    server = ControlServer(
        journal,
        supervisor.statuses,
        supervisor.stop,
        supervisor.simulated_time,
        requests.handle,
        lambda: supervisor.plan.externals,
        supervisor.external_connections.statuses,
        [process.name for process in plan.processes if process.is_program],
    )
    await server.open(lock.folder / instances.SOCKET)
    path = str(plan.path.resolve())
    lock.publish(
        instances.RunningDeployment(plan.name, path, plan.domain, os.getpid(), time.time())
    )

    def abort(reason: str) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed: it has ended already
            loop.call_soon_threadsafe(partial(supervisor.stop, reason, EXIT_BROKEN_PIPE))

    def log(text: str) -> None:
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(partial(supervisor.log, text, "WARNING"))

    display.attach(supervisor.statuses, abort, log)
    if store:
        store.attach(log)
    supervisor.receive_notifications(lock.folder)
    if any(map(is_forkable, plan.processes)):
        token = {DEPLOYMENT_VARIABLE: supervisor.token}
        supervisor.starter = ForkServer(token, supervisor.log)
    watch = loop.create_task(reaper.watch(supervisor.log))
    outcome = Outcome(1, "rcdeploy itself failed")
    try:
        outcome = await supervisor.run()
    finally:
        watch.cancel()
        await server.close(asdict(outcome))
    return outcome
