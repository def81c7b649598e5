"""The ports of a component in lock-step: every message is a call that returns when it was handled.

In: a middleware. Out: a `Middleware` in front of it. Each interface has a twin whose operations are
all queries and carry the simulated time, which the receiver's clock is then set to; components in
lock-step speak through the twins. Onlookers still see the interfaces as they are.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from robocomp_dsl.runtime.clock_interface import CLOCK, Hearer
from robocomp_dsl.runtime.errors import MiddlewareError, NoServer, RemoteError
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint, Link, Middleware
from robocomp_dsl.runtime.middleware.calling import reaches
from robocomp_dsl.runtime.schema import LONG

PART = 0.25
"""Of the limit of a step: what handling one publication may take."""

log = logging.getLogger("robocomp")


@cache
def twin(interface: Interface) -> Interface:
    """The same operations as queries with the time in front."""
    return Interface(
        f"{interface.name} in step",
        tuple(
            replace(one, pattern=Pattern.QUERY, inputs=(("now_in_step", LONG), *one.inputs))
            for one in interface.operations
        ),
    )


class StepPorts:
    """See the module. `now` gives the time in ns that goes out, `reach` is told what came in."""

    def __init__(
        self,
        inner: Middleware,
        limit: float,
        now: Callable[[], int],
        reach: Callable[[int], None],
    ) -> None:
        self._inner = inner
        self._limit = limit
        self._now = now
        self._reach = reach
        self._topics: list[StepTopic] = []
        self.hearers: list[Hearer] = []

    def serve(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """See `base.Middleware`."""
        self._inner.serve(at, handlers, execution)
        self._serve_twin(at, handlers, execution)

    def proxy(self, at: Endpoint) -> Link:
        """See `base.Middleware`."""
        link = self._inner.proxy(replace(at, interface=twin(at.interface)))
        return StepLink(link, twin(at.interface), self._now)

    def advertise(self, at: Endpoint) -> Link:
        """See `base.Middleware`."""
        link = self._inner.advertise(at)
        if at.interface.name == CLOCK.name:
            return link
        made = StepTopic(link, at, self._inner, self._now, self._limit)
        self._topics.append(made)
        return made

    def subscribe(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """See `base.Middleware`."""
        if at.interface.name == CLOCK.name:
            self._inner.subscribe(at, handlers, execution)
            return
        self._serve_twin(at, handlers, execution)
        peers = list(at.peers)
        self.hearers.append(Hearer(at.component, at.port, at.interface.name, peers))

    def _serve_twin(
        self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution
    ) -> None:
        timed = {name: self._timed(handler) for name, handler in handlers.items()}
        self._inner.serve(replace(at, interface=twin(at.interface)), timed, execution)

    def _timed(self, handler: Bound) -> Bound:
        reach = self._reach

        def timed(now: int, *arguments: Any) -> Any:
            reach(now)
            return handler(*arguments)

        return timed

    def meet(self, everyone: Iterable[Hearer]) -> None:
        """Find those who hear what is published here; waits for each."""
        everyone = sorted(everyone, key=lambda one: (one.component, one.port))
        for topic in self._topics:
            topic.meet(everyone)

    def announce(self, state: str) -> None:
        """See `base.Middleware`."""
        self._inner.announce(state)

    def interrupt(self) -> None:
        """See `base.Middleware`."""
        self._inner.interrupt()

    def close(self) -> None:
        """See `base.Middleware`."""
        self._inner.close()


class StepLink:
    """Calls a server through the twin of its interface."""

    def __init__(self, link: Link, interface: Interface, now: Callable[[], int]) -> None:
        self._link = link
        self._interface = interface
        self._now = now

    @property
    def timeout(self) -> float:
        """See `base.Link`."""
        return self._link.timeout

    @timeout.setter
    def timeout(self, seconds: float) -> None:
        self._link.timeout = seconds

    def bind(self, operation: Operation) -> Bound:
        """See `base.Link`."""
        call, now = self._link.bind(self._interface.operation(operation.name)), self._now
        return lambda *arguments: call(now(), *arguments)

    def wait(self, timeout: float) -> bool:
        """See `base.Link`."""
        return self._link.wait(timeout)

    def heard(self) -> bool:
        """See `base.Link`."""
        return self._link.heard()


class StepTopic:
    """Publishes to one subscriber after the other, in the order of their names."""

    def __init__(
        self, link: Link, at: Endpoint, inner: Middleware, now: Callable[[], int], limit: float
    ) -> None:
        self._link = link
        self._at = at
        self._inner = inner
        self._now = now
        self._limit = limit
        self._links: dict[str, Link] = {}
        self._calls: dict[str, dict[str, Bound]] = {}
        self.timeout = 0.0

    def meet(self, everyone: Iterable[Hearer]) -> None:
        """From now on those of `everyone` hear this topic that are subscribed to it."""
        calls: dict[str, dict[str, Bound]] = {}
        for one in everyone:
            if self._hears(one):
                name = f"{one.component}.{one.port}"
                link = self._links.get(name) or self._linked(name)
                self._links[name] = link
                link.wait(self._limit * PART)
                operations = twin(self._at.interface).operations
                calls[name] = {each.name: link.bind(each) for each in operations}
        self._calls = calls

    def _hears(self, one: Hearer) -> bool:
        at = Endpoint(self._at.interface, one.component, one.port, tuple(one.publishers))
        named = one.declared == self._at.interface.name
        return named and reaches(at, self._at.component, self._at.port)

    def _linked(self, name: str) -> Link:
        port = f"{self._at.port} to {name}"
        at = Endpoint(twin(self._at.interface), self._at.component, port, (name,))
        made = self._inner.proxy(at)
        made.timeout = self._limit * PART
        return made

    def bind(self, operation: Operation) -> Bound:
        """See `base.Link`."""
        plain, name = self._link.bind(operation), operation.name

        def publish(*arguments: Any) -> None:
            plain(*arguments)
            for hearer, calls in list(self._calls.items()):
                try:
                    calls[name](self._now(), *arguments)
                except RemoteError:
                    pass  # told where it happened
                except MiddlewareError as error:
                    self._lose(hearer, error)

        return publish

    def _lose(self, hearer: str, error: MiddlewareError) -> None:
        if self._calls.pop(hearer, None) is not None:
            # The source tells who has gone.
            level = logging.DEBUG if isinstance(error, NoServer) else logging.WARNING
            log.log(level, "%s hears %s no more: %s", hearer, self._at.port, error)

    def wait(self, timeout: float) -> bool:
        """See `base.Link`."""
        return bool(self._calls) or self._link.wait(timeout)

    def heard(self) -> bool:
        """See `base.Link`."""
        return bool(self._calls) or self._link.heard()
