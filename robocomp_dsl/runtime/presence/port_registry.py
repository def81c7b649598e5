"""Registry of the ports of a domain; a presence keeps it up to date.

In: records that appear and disappear. Out: the ports that exist now, a wait until a port exists,
and a callback when one is lost.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from robocomp_dsl.runtime.presence.port_record import PortRecord

log = logging.getLogger("robocomp")


class PortRegistry:
    """The ports of a domain; `version` changes with every change.

    `outage` says that no other port can be reached now; `interruptions` counts how often messages
    may have been lost because a router was away; `has_router`: a router connects the domain.
    """

    def __init__(self) -> None:
        self._records: dict[str, PortRecord] = {}
        self._on_lost: dict[PortRecord, list[Callable[[], None]]] = {}
        self._expected_peers: dict[tuple[str, str], tuple[str, str]] = {}
        self._changed = threading.Condition()
        self.version = 0
        self.closed = False
        self.outage = ""
        self.interruptions = 0
        self.has_router = False

    def add(self, key: str, record: PortRecord) -> None:
        """A port exists; `key` identifies it for `remove`."""
        with self._changed:
            if self._records.get(key) == record:
                return
            self._records[key] = record
            self._check_version(record)
            self._notify()

    def remove(self, key: str) -> None:
        """A port exists no longer."""
        with self._changed:
            lost = self._records.pop(key, None)
            ended = lost is not None and lost not in self._records.values()
            callbacks = self._on_lost.pop(lost, []) if lost and ended else []
            self._notify()
        for callback in callbacks:
            callback()

    def _notify(self) -> None:
        self.version += 1
        self._changed.notify_all()

    def warn_on_mismatch(self, role: str, interface: str, hash_: str, component: str) -> None:
        """Log a warning when a port of the other side of a topic has another interface version.

        Its messages would not arrive, without any error.
        """
        with self._changed:
            self._expected_peers[role, interface] = (hash_, component)
            for record in self._matching(role, interface):
                self._check_version(record)

    def _check_version(self, record: PortRecord) -> None:
        expected = self._expected_peers.get((record.role, record.interface))
        if expected and record.hash and record.hash != expected[0]:
            log.warning(
                "%s and %s have different versions of %s (InterfaceMismatch): messages of"
                " operations that differ do not arrive; generate both from the same IDSL file",
                expected[1],
                record.component,
                record.interface,
            )

    def set_outage(self, outage: str) -> None:
        """The router of this host is away, as `outage` says; empty: a router is back."""
        if outage:
            log.warning("%s: calls fail, and messages are lost, until it is back", outage)
        elif self.outage:
            log.info("the router of this host is back")
        with self._changed:
            self.outage = outage
            self.interruptions += not outage
            self._notify()

    def invalidate(self) -> None:
        """Let all calls search their server again."""
        with self._changed:
            self.version += 1

    def notify(self) -> None:
        """As `invalidate`; also wake all waiting threads."""
        with self._changed:
            self._notify()

    def wait_for_change(self, version: int, seconds: float) -> None:
        """Wait at most `seconds` until the registry has another version."""
        with self._changed:
            self._changed.wait_for(lambda: self.version != version or self.closed, max(seconds, 0))

    def on_lost(self, record: PortRecord, callback: Callable[[], None]) -> None:
        """Call `callback` once when the port is lost or `interrupt` is called; at once if it is.

        A port of a program that is no component has no hash; no presence knows when it is lost.
        """
        with self._changed:
            known = not record.hash or record in self._records.values()
            present = known and not self.closed
            if present:
                self._on_lost.setdefault(record, []).append(callback)
        if not present:
            callback()

    def find(self, role: str, interface: str) -> list[PortRecord]:
        """The ports with a role and an interface, in the order in which they appeared."""
        with self._changed:
            return self._matching(role, interface)

    def _matching(self, role: str, interface: str) -> list[PortRecord]:
        every = self._records.values()
        return [record for record in every if record.role == role and record.interface == interface]

    def has(self, record: PortRecord) -> bool:
        """Whether the port exists."""
        with self._changed:
            return record in self._records.values()

    def wait(
        self, role: str, interface: str, fits: Callable[[PortRecord], bool], seconds: float
    ) -> list[PortRecord]:
        """The matching ports, waiting at most `seconds` for the first port."""

        def fitting() -> list[PortRecord]:
            return [record for record in self._matching(role, interface) if fits(record)]

        with self._changed:
            self._changed.wait_for(lambda: fitting() or self.closed, max(seconds, 0.0))
            return fitting()

    def wait_lost(self, record: PortRecord, seconds: float) -> None:
        """Wait until the port is lost, at most `seconds`: its connection may break before."""

        def lost() -> bool:
            return self.closed or record not in self._records.values()

        with self._changed:
            self._changed.wait_for(lost, seconds)

    def interrupt(self) -> None:
        """Wake all waiting threads, and report all ports as lost."""
        with self._changed:
            self.closed = True
            callbacks = [callback for each in self._on_lost.values() for callback in each]
            self._on_lost.clear()
            self._notify()
        for callback in callbacks:
            callback()
