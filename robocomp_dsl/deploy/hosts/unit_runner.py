"""Starts and stops components on several hosts in order, and waits until they are ready.

In: agents of the hosts, components. Out: lines of text for the user, and the components that
failed. A component starts when all that it starts after are ready.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Collection, Iterable, Mapping
from functools import partial

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_report import UnitState
from robocomp_dsl.deploy.hosts.manifest import HostedComponent
from robocomp_dsl.deploy.plan import batches

MARGIN_S = 15.0
"""Time beyond the limit of a start, until the host reports its end over a slow link."""


class UnitRunner:
    """Runs the units of one deployment; `report` gets lines of text."""

    def __init__(
        self,
        agents: Mapping[str, HostAgent],
        components: Mapping[str, HostedComponent],
        report: Callable[[str], object],
    ) -> None:
        self._agents = agents
        self._components = components
        self._report = report
        self._states: dict[str, UnitState] = {}
        self._operations: dict[str, int] = {}
        self._lost: dict[str, HostError] = {}
        self._changed = asyncio.Condition()
        self._tasks: set[asyncio.Task[None]] = set()
        self.failed: dict[str, str] = {}

    async def watch(self) -> None:
        """Receive the states of all units from now on. Raises `HostError`."""
        for host, agent in self._agents.items():
            units = {c.unit: c.name for c in self._components.values() if c.host == host}
            agent.on_failure = partial(self._on_lost, host)  # type: ignore[method-assign]
            await agent.watch(list(units), partial(self._on_state, units))

    def _on_state(self, units: Mapping[str, str], unit: str, state: UnitState) -> None:
        name = units.get(unit, "")
        if name and state.operations >= self._operations.get(name, 0):
            self._states[name] = state
            self._notify()

    def _on_lost(self, host: str, error: HostError) -> None:
        self._lost[host] = error
        self._notify()

    def _notify(self) -> None:
        async def notify() -> None:
            async with self._changed:
                self._changed.notify_all()

        task = asyncio.get_running_loop().create_task(notify())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def stop(self, names: Collection[str], *, quiet: bool = False) -> bool:
        """Stop components, users first; returns whether all exited in time."""
        succeeded = True
        for batch in batches({c.name: set(c.stops_after) for c in self._components.values()}):
            stopped = [self._components[name] for name in batch if name in names]
            results = await asyncio.gather(*map(self._stop_component, stopped))
            for component, problem in zip(stopped, results, strict=True):
                succeeded &= not problem
                if problem or not quiet:
                    self._report(f"{component.name} ({component.host}): {problem or 'stopped'}")
        return succeeded

    async def _stop_component(self, component: HostedComponent) -> str:
        """Stop one component; returns what went wrong."""
        agent = self._agents.get(component.host)
        if agent is None:
            return "its host does not answer"
        try:
            await self._operate(agent, "stop", component)
            state = await self._settled(component, time.monotonic() + MARGIN_S, _is_down)
        except HostError as error:
            return error.message
        if state is None or state.result != "timeout":
            return ""
        return "did not exit in time and was killed"

    async def start(self, names: Collection[str], restarted: Collection[str] = ()) -> bool:
        """Start or restart components in order; returns whether all are ready."""
        ready = {name: asyncio.get_running_loop().create_future() for name in names}
        await asyncio.gather(
            *(self._start_component(name, ready, name in restarted) for name in names)
        )
        return all(future.result() for future in ready.values())

    async def _start_component(
        self, name: str, ready: Mapping[str, asyncio.Future[bool]], is_restart: bool
    ) -> None:
        component = self._components[name]
        reason = ""
        for required in component.after:
            if required in ready and not await ready[required]:
                reason = f"not started: {required} is not ready"
        if not reason:
            reason = await self._run_start(component, "restart" if is_restart else "start")
        if reason:
            self.failed[name] = reason
            self._report(f"{name} ({component.host}): {reason}")
        ready[name].set_result(not reason)

    async def _run_start(self, component: HostedComponent, verb: str) -> str:
        """Start a unit and wait until it is ready; returns what went wrong."""
        agent = self._agents.get(component.host)
        if agent is None:
            return "not started: its host does not answer"
        began = time.monotonic()
        limit = component.start_timeout_s + MARGIN_S
        try:
            await agent.systemctl("reset-failed", [component.unit])
            await self._operate(agent, verb, component)
            state = await self._settled(component, began + limit, _is_up)
        except HostError as error:
            return error.message
        if state is None:
            return f"not ready within {limit:g} s"
        return self._report_start(component, state, time.monotonic() - began)

    def _report_start(self, component: HostedComponent, state: UnitState, seconds: float) -> str:
        place = f"{component.name} ({component.host})"
        if state.state == status.READY:
            self._report(f"{place}: ready after {seconds:.2f} s (pid {state.pid})")
            return ""
        if state.state == status.EXITED and not state.note:
            self._report(f"{place}: has ended")
            return ""
        return state.note or state.state

    async def _operate(self, agent: HostAgent, verb: str, component: HostedComponent) -> None:
        name = component.name
        self._operations[name] = self._operations.get(name, 0) + 1
        self._states.pop(name, None)
        await agent.systemctl(verb, [component.unit])

    async def _settled(
        self,
        component: HostedComponent,
        deadline: float,
        is_settled: Callable[[UnitState], bool],
    ) -> UnitState | None:
        """The state of a component when it is settled; None after `deadline`.

        Raises `HostError` if the connection to its host is lost.
        """
        name = component.name
        async with self._changed:
            while True:
                if lost := self._lost.get(component.host):
                    raise lost
                state = self._states.get(name)
                if state is not None and is_settled(state):
                    return state
                try:
                    async with asyncio.timeout(deadline - time.monotonic()):
                        await self._changed.wait()
                except TimeoutError:
                    return None


def _is_up(state: UnitState) -> bool:
    """Whether a start has come to its end."""
    return state.state in (status.READY, status.FAILED) or _is_down(state)


def _is_down(state: UnitState) -> bool:
    return state.state in (status.EXITED, status.FAILED) and not state.has_job


def with_requirements(
    names: Iterable[str], components: Mapping[str, HostedComponent], running: Collection[str]
) -> list[str]:
    """`names` and what they start after that does not run, in the order of `components`."""
    pending, found = list(names), set(names)
    while pending:
        for name in components[pending.pop()].after:
            if name in components and name not in found and name not in running:
                found.add(name)
                pending.append(name)
    return [name for name in components if name in found]
