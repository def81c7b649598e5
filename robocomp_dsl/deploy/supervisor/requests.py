"""Starts, stops and restarts single components of a running deployment on request.

In: a verb and names of components or groups. Out: messages for the requester, and whether the
request succeeded. Requests are handled one after the other. What is started runs the command line
of the description as it is now; the domain stays the same.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

from robocomp_dsl.deploy.plan import Plan, Process, batches
from robocomp_dsl.deploy.selection import NoSuchComponent, select_names

if TYPE_CHECKING:
    from robocomp_dsl.deploy.supervisor.supervisor import Supervisor

VERBS = ("start", "stop", "restart")
Notify: TypeAlias = Callable[[str], Awaitable[None]]
"""Sends one line of text to the requester."""


class PlanRejected(Exception):
    """The description has errors now; the message lists them."""


Replan: TypeAlias = Callable[[], tuple[Plan, str]]
"""The plan of the description as it is now, and warnings. Raises `PlanRejected`."""


class ComponentRequests:
    """Handles the requests to one supervisor. Without `replan` the first plan stays in force."""

    def __init__(self, supervisor: Supervisor, replan: Replan | None = None) -> None:
        self._supervisor = supervisor
        self._replan = replan
        self._lock = asyncio.Lock()

    async def handle(self, verb: str, names: Sequence[str], notify: Notify) -> bool:
        """Handle one request, with all components if `names` is empty; returns its success."""
        async with self._lock:
            if self._supervisor.stopping.is_set():
                await notify("the deployment is stopping; nothing was done")
                return False
            try:
                plan = self._supervisor.plan
                if verb != "stop" and self._replan:
                    plan, warnings = await asyncio.to_thread(self._replan)
                    if warnings:
                        await notify(warnings)
                selected = self._select(names, plan, verb)
                if verb == "start" and not names:
                    selected = [n for n in selected if not self._supervisor.is_available(n)]
            except (PlanRejected, NoSuchComponent) as error:
                await notify(f"{error}")
                return False
            with self._supervisor.kept_running():
                succeeded = True
                if verb != "start":
                    succeeded = await self._stop(selected, notify, quiet=verb == "restart")
                if verb != "stop" and not self._supervisor.stopping.is_set():
                    succeeded &= await self._start(selected, plan, notify)
                return succeeded

    def _select(self, names: Sequence[str], plan: Plan, verb: str) -> list[str]:
        """The full names. A component that the file no longer has can only be stopped."""
        if not names:
            return [process.name for process in plan.processes]
        running = self._supervisor.plan
        try:
            return select_names(names, plan.processes)
        except NoSuchComponent:
            if verb != "stop":
                removed = select_names(names, running.processes)
                text = f"{plan.path.name} no longer has {_listing(removed)}; it can only be stopped"
                raise NoSuchComponent(text) from None
            raise

    async def _stop(self, names: list[str], notify: Notify, *, quiet: bool) -> bool:
        supervisor = self._supervisor
        succeeded = True
        for batch in supervisor.plan.shutdown_batches():
            stopped = [name for name in batch if name in names and supervisor.is_active(name)]
            results = await asyncio.gather(*map(supervisor.stop_component, stopped))
            succeeded &= all(results)
            for name, exited in zip(stopped, results, strict=True):
                note = "stopped" if exited else "did not exit in time and was killed"
                await notify(f"{name}: {note}")
            for name in batch:
                if name in names and name not in stopped and not quiet:
                    await notify(f"{name}: was not running")
        if (users := self._users(names)) and not quiet:
            await notify(f"still running without it: {_listing(users)}")
        return succeeded

    def _users(self, names: list[str]) -> list[str]:
        """Running components that depend on stopped ones."""
        return [
            process.name
            for process in self._supervisor.plan.processes
            if process.name not in names
            and set(process.after) & set(names)
            and self._supervisor.is_active(process.name)
        ]

    async def _start(self, names: list[str], plan: Plan, notify: Notify) -> bool:
        supervisor = self._supervisor
        required = self._with_requirements(names, plan)
        for name in names:
            if supervisor.is_active(name):
                await notify(f"{name}: is already running")
        started = [name for name in required if not supervisor.is_active(name)]
        supervisor.plan = merge_plans(supervisor.plan, plan, started)
        supervisor.start_components(started)
        succeeded = True
        for batch in batches({p.name: set(p.after) for p in plan.processes}):
            for name in (name for name in batch if name in started):
                ready = await supervisor.wait_until_ready(name)
                succeeded &= ready
                status = supervisor.status_of(name)
                pid = f" (pid {status.pid})" if status.pid else ""
                note = f": {status.note}" if status.note else ""
                await notify(f"{name}: {status.state}{pid}{note}")
        if outdated := changed_names(supervisor.plan, plan):
            await notify(f"the file has changed these, too; restart them: {_listing(outdated)}")
        return succeeded

    def _with_requirements(self, names: list[str], plan: Plan) -> list[str]:
        """`names` and the components that they start after, which are not available."""
        after = {process.name: process.after for process in plan.processes}
        pending, found = list(names), set(names)
        while pending:
            for name in after[pending.pop()]:
                if name not in found and not self._supervisor.is_available(name):
                    found.add(name)
                    pending.append(name)
        return [name for name in after if name in found]


def merge_plans(running: Plan, current: Plan, started: Iterable[str]) -> Plan:
    """The plan that is in force when `started` run as in `current` and the others as they are.

    The order of start and stop is that of `current`, so that it has no cycle.
    """
    new = {process.name: process for process in current.processes}
    old = {process.name: process for process in running.processes}
    renewed = set(started)
    merged: list[Process] = []
    for name, process in new.items():
        if name in renewed or name not in old:
            merged += [process] if name in renewed else []
        else:
            order = {"after": process.after, "stops_after": process.stops_after}
            merged.append(replace(old[name], **order))  # type: ignore[arg-type]
    removed = (p for p in running.processes if p.name not in new)
    return replace(running, processes=(*merged, *(replace(p, after=()) for p in removed)))


def changed_names(running: Plan, current: Plan) -> list[str]:
    """The components that would now be started with another command line or environment."""
    new = {process.name: process for process in current.processes}
    return [
        process.name
        for process in running.processes
        if process.name in new
        and (process.argv, process.env, process.cwd)
        != (new[process.name].argv, new[process.name].env, new[process.name].cwd)
    ]


def _listing(names: Sequence[str]) -> str:
    return ", ".join(names)
