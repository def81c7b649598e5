"""A deployment from its claim to its end: engine, sentinel, control socket and signals together.

In: a plan, a watch, where records go. Out: the outcome; nothing of it is left, however it ended.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict
from functools import partial
from pathlib import Path

from robocomp_dsl.deploy import folder
from robocomp_dsl.deploy.control import Journal, Server
from robocomp_dsl.deploy.engines import sentinel
from robocomp_dsl.deploy.engines.local import Local, Options, Outcome
from robocomp_dsl.deploy.engines.watch import Watch
from robocomp_dsl.deploy.logs import Record
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.deploy.status import Row

_SIGNALS = {
    signal.SIGINT: "Ctrl-C",
    signal.SIGTERM: "SIGTERM",
    signal.SIGHUP: "the terminal was closed",
}


class Display:
    """Where a session shows itself; this one shows nothing."""

    def record(self, record: Record) -> None:
        """A line of output."""

    def attach(self, rows: Callable[[], list[Row]], stop: Callable[[str], object]) -> None:
        """How to get the status, and how to stop when nobody reads any more; from any thread."""

    def changed(self) -> None:
        """The status is another one now."""


def run(
    plan: Plan, claim: folder.Claim, watch: Watch, display: Display, options: Options
) -> Outcome:
    """Run `plan` in the foreground until it ends or is stopped."""
    journal = Journal()

    def emit(record: Record) -> None:
        journal.add(record)
        display.record(record)

    token = f"{plan.domain}.{os.getpid()}"
    engine = Local(plan, token, watch, emit=emit, changed=display.changed, options=options)
    with _sentinel(token, options.grace_s):
        return asyncio.run(_run(engine, journal, claim, display))


async def _run(engine: Local, journal: Journal, claim: folder.Claim, display: Display) -> Outcome:
    loop = asyncio.get_running_loop()
    for number, reason in _SIGNALS.items():
        loop.add_signal_handler(number, engine.stop, reason)
    plan = engine.plan
    server = Server(journal, engine.rows, engine.stop, engine.time)
    await server.open(claim.folder / folder.SOCKET)
    path = str(plan.path.resolve())
    claim.tell(folder.Running(plan.name, path, plan.domain, os.getpid(), time.time()))
    display.attach(engine.rows, lambda why: loop.call_soon_threadsafe(partial(engine.stop, why)))
    outcome = Outcome(1, "rcdeploy itself failed")
    try:
        outcome = await engine.run()
    finally:
        await server.close(asdict(outcome))
    return outcome


@contextlib.contextmanager
def _sentinel(token: str, grace_s: float) -> Iterator[None]:
    """A process that ends ours should we be killed; it lives as long as our end of the pipe."""
    script = Path(sentinel.__file__)
    command = [sys.executable, "-I", "-S", str(script), token, str(grace_s)]
    process = subprocess.Popen(  # noqa: S603 - our own script
        command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, start_new_session=True
    )
    try:
        yield
    except BaseException:
        process.communicate()
        raise
    process.communicate(sentinel.NOTHING_LEFT)
