"""A subscribed port: one subscription for each peer that it names, on each of its middlewares.

In: the port, which may change while it is open. Out: subscriptions that are opened and closed;
those that do not change receive without interruption.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.connection_watch import WatchedSubscription
from robocomp_dsl.runtime.connection.endpoint import NOBODY, Endpoint, Qos
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.port_opener import PortOpener
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.connection.qos_merge import connection_qos, sender_qos
from robocomp_dsl.runtime.middleware import registry
from robocomp_dsl.runtime.middleware.transport import Subscription
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import Presence


@dataclass(slots=True)
class OpenSubscription:
    """One subscription of a port on one middleware."""

    middleware: str
    at: Endpoint
    port: IncomingPort
    subscription: Subscription
    record: PortRecord
    watched: WatchedSubscription | None


class SubscribedPort:
    """One subscribed port of a component; `at` is the port as it is now."""

    def __init__(
        self,
        ports: PortOpener,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
    ) -> None:
        self.at = at
        self._ports = ports
        self._handlers = handlers
        self._execution = execution
        self._open: dict[tuple[str, tuple[str, ...]], OpenSubscription] = {}

    @property
    def subscriptions(self) -> list[OpenSubscription]:
        """The subscriptions that are open."""
        return list(self._open.values())

    def update(self, at: Endpoint, *, is_start: bool = False) -> None:
        """Open, change and close subscriptions. Raises `MiddlewareError` if one cannot be opened.

        A subscription whose queue changes is opened again: messages that arrive meanwhile are lost.
        """
        parts = {
            (middleware, part.peers): part
            for middleware in self._ports.middlewares(at)
            for part in split(at)
        }
        for key, former in list(self._open.items()):
            part = parts.get(key)
            if part is None or not (part == former.at or _adjust(former, part)):
                del self._open[key]
                self._close(former)
        for key, part in parts.items():
            if key not in self._open:
                self._open[key] = self._subscribe(key[0], part, is_start=is_start)
        self.at = at

    def _subscribe(self, middleware: str, at: Endpoint, *, is_start: bool) -> OpenSubscription:
        capabilities = registry.capabilities_of(middleware)
        port = self._ports.incoming_port(
            at,
            self._handlers,
            self._execution,
            count_losses=capabilities.sequence_numbers,
            is_start=is_start,
        )
        watch = None
        fetches_latest = bool(at.qos.latched) and not capabilities.latches
        if at.qos.deadline or at.qos.liveliness or fetches_latest:
            watch = self._ports.watch.add(port, fetches_latest=fetches_latest)
        subscription = self._ports.transport(middleware).subscribe(port)
        record = self._ports.declare("subscriber", at, middleware, subscription.address)
        if watch:
            self._ports.watch.start()
        return OpenSubscription(middleware, at, port, subscription, record, watch)

    def _close(self, opened: OpenSubscription) -> None:
        if opened.watched:
            self._ports.watch.remove(opened.watched)
        self._ports.presence.withdraw(opened.record)
        opened.subscription.close()
        opened.port.join(0.5)
        self._ports.forget(opened.port)

    def withdraw(self, presence: Presence) -> None:
        """Make the subscriptions unknown, before they are closed."""
        for opened in self._open.values():
            presence.withdraw(opened.record)

    def close(self) -> None:
        """Close all subscriptions; running handlers may finish."""
        for opened in self._open.values():
            opened.subscription.close()


def split(at: Endpoint) -> Iterable[Endpoint]:
    """The port as one endpoint for each peer, with the quality of service of that connection."""
    if not at.peers or at.external:
        return (replace(at, qos=sender_qos(at), peer_qos=()),)
    peers = [peer for peer in dict.fromkeys(at.peers) if peer != NOBODY]
    return [replace(at, peers=(peer,), qos=connection_qos(at, peer), peer_qos=()) for peer in peers]


def _adjust(opened: OpenSubscription, part: Endpoint) -> bool:
    """Change what needs no new subscription; False if something else differs, too."""
    qos = part.qos
    if replace(opened.at, qos=_fixed(opened.at.qos)) != replace(part, qos=_fixed(qos)):
        return False
    if (qos.deadline or qos.liveliness) and not opened.watched:
        return False
    if opened.watched:
        opened.watched.set_limits(qos.deadline or 0.0, qos.liveliness or 0.0)
    if qos.thread_priority != opened.at.qos.thread_priority:
        opened.port.set_thread_priority(qos.thread_priority)
    opened.at = part
    return True


def _fixed(qos: Qos) -> Qos:
    """The items that cannot be changed without a new subscription."""
    return replace(qos, deadline=None, liveliness=None, thread_priority=None, priority=None)
