"""Deadlines, liveliness and latest values of the subscriptions of one component.

In: subscriptions with these items. Out: events to the component, counts, and latest values. One
thread sleeps until the next moment that can matter, or until the port registry changes.
"""

from __future__ import annotations

import logging
import math
import threading
import time

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.connection.connection_events import ConnectionEvents
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.latest_values import LatestValues
from robocomp_dsl.runtime.connection.message_times import MessageTimes
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.publisher_watch import PublisherWatch
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import Presence

MAX_SLEEP_S = 60.0
log = logging.getLogger("robocomp")


class WatchedSubscription:
    """One subscription; it also collects the latest values of its publishers if it is latched."""

    def __init__(self, port: IncomingPort, watch: ConnectionWatch, *, fetches_latest: bool) -> None:
        self.at: Endpoint = port.at
        self._watch = watch
        qos = port.at.qos
        self.times = MessageTimes(qos.deadline or 0.0, self._on_missed)
        self.publishers = PublisherWatch(
            qos.liveliness or 0.0, watch.presence.probe, self._on_changed
        )
        self.latest = LatestValues(port, watch.presence, watch.events) if fetches_latest else None
        for operation in port.operations.values():
            self.times.observe(operation)

    def set_limits(self, deadline: float, liveliness: float) -> None:
        """Change the limits in s; 0.0: none."""
        self.times.deadline = deadline
        self.publishers.liveliness = liveliness
        self._watch.start()

    def _on_missed(self, seconds: float, counts: OperationCounts | None) -> None:
        if counts is not None:
            counts.missed += 1
        at, limit = self.at, self.times.deadline
        self._watch.warn(
            f"{at.port} deadline",
            f"{at.name} received nothing for {seconds * 1000:.0f} ms; its deadline is"
            f" {limit * 1000:g} ms",
        )
        self._watch.events.notify("deadline_missed", at.port, seconds)

    def _on_changed(self, publisher: str, alive: bool) -> None:
        if not alive:
            limit = self.publishers.liveliness * 1000
            self._watch.warn(
                f"{self.at.port} {publisher}",
                f"{self.at.name} lost its publisher {publisher} (liveliness {limit:g} ms)",
            )
        hook = "publisher_alive" if alive else "publisher_lost"
        self._watch.events.notify(hook, self.at.port, publisher)

    def matching(self, records: list[PortRecord]) -> list[PortRecord]:
        """The publishers that this subscription receives."""
        at = self.at
        if at.external and not at.peers:
            return list(at.external)
        hash_ = at.interface.hash.hex()
        middlewares = at.middlewares
        known = [
            record
            for record in records
            if record.hash == hash_
            and matches(at, record.component, record.port)
            and (not middlewares or record.middleware in middlewares)
        ]
        return [*at.external, *known]


class ConnectionWatch:
    """The watched subscriptions of one component. The thread starts with the first subscription."""

    def __init__(self, presence: Presence, events: ConnectionEvents, component: str) -> None:
        self.presence = presence
        self.events = events
        self._component = component
        self._subscriptions: list[WatchedSubscription] = []
        self._throttle = Throttle()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._closed = False

    def add(self, port: IncomingPort, *, fetches_latest: bool) -> WatchedSubscription:
        """Watch a subscription from now on; before the transport subscribes."""
        subscription = WatchedSubscription(port, self, fetches_latest=fetches_latest)
        with self._lock:
            self._subscriptions.append(subscription)
        return subscription

    def start(self) -> None:
        """After the transport has subscribed: publishers that exist count from now on."""
        with self._lock:
            if self._thread is None:
                name = f"{self._component}.deadlines"
                self._thread = threading.Thread(target=self._run, name=name, daemon=True)
                self._thread.start()
        self.presence.registry.notify()

    def remove(self, subscription: WatchedSubscription) -> None:
        """Watch a subscription no longer."""
        with self._lock:
            if subscription in self._subscriptions:
                self._subscriptions.remove(subscription)

    def warn(self, key: str, text: str) -> None:
        """Log a warning, one in a while for the same key."""
        if self._throttle.allows(key):
            log.warning("%s", text)

    def _run(self) -> None:
        registry, version = self.presence.registry, -1
        while not self._closed and not registry.closed:
            if version != registry.version:
                version = registry.version
                self._update()
            sleep = max(0.0, self._check() - time.monotonic())
            registry.wait_for_change(version, min(sleep, MAX_SLEEP_S))

    def _update(self) -> None:
        """The ports of the domain have changed."""
        now = time.monotonic()
        with self._lock:
            subscriptions = list(self._subscriptions)
        for subscription in subscriptions:
            records = self.presence.registry.find("publisher", subscription.at.interface.name)
            publishers = subscription.matching(records)
            if publishers:
                subscription.times.start()
            subscription.publishers.update(publishers, now)
            if subscription.latest:
                subscription.latest.update(publishers)

    def _check(self) -> float:
        """Check everything; returns the time of the next check."""
        now, due = time.monotonic(), math.inf
        with self._lock:
            subscriptions = list(self._subscriptions)
        for subscription in subscriptions:
            due = min(due, subscription.times.check(now))
            due = min(due, subscription.publishers.check(now, subscription.times.latest))
            if subscription.latest:
                due = min(due, subscription.latest.check(now))
        return due

    def close(self) -> None:
        """End the thread."""
        self._closed = True
        self.presence.registry.notify()
        if self._thread and self._thread is not threading.current_thread():
            self._thread.join(1.0)
