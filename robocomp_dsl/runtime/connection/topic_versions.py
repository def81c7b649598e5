"""Publishes a topic to subscribers that were generated from another version of its interface.

In: the subscribers of a port. Out: for each other version a publisher of its own, with the type
hash of that version, for the operations that have the same shape on both sides. What differs is
logged once for each version. Latest messages for late subscribers are not kept for other versions.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, replace
from typing import Any

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.interface_version import (
    PeerInterface,
    ShapesOf,
    is_other_version,
    shapes_of_peer,
)
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.connection.published_port import PublishedPort
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT

log = logging.getLogger("robocomp")
OpenPort = Callable[[str, Endpoint], PublishedPort]


@dataclass(slots=True)
class _Version:
    """One other version; `port` is None if it has no operation in common."""

    port: PublishedPort | None
    interface: PeerInterface | None
    attached: set[PortRecord]
    functions: dict[str, OperationCallable]


class TopicVersions:
    """The other versions of one published port."""

    def __init__(self, at: Endpoint, shapes_of: ShapesOf, open_port: OpenPort) -> None:
        self._at = at
        self._shapes_of = shapes_of
        self._open = open_port
        self._versions: dict[tuple[str, str], _Version] = {}
        self._bound: dict[str, tuple[Operation, list[OperationCallable]]] = {}

    def bind(self, operation: Operation) -> list[OperationCallable]:
        """The functions that publish an operation to other versions; `update` changes the list."""
        functions = [v for each in self._versions.values() if (v := self._bind(each, operation))]
        self._bound[operation.name] = operation, functions
        return functions

    def update(self, at: Endpoint, subscribers: Iterable[PortRecord]) -> None:
        """These are the subscribers of `at` now, with any version of the interface."""
        if at != self._at:
            self.close()
            self._at = at
        others = [record for record in subscribers if is_other_version(at, record)]
        for key in self._versions.keys() - {(r.middleware, r.hash) for r in others}:
            self._close(self._versions.pop(key))
        for record in others:
            key = record.middleware, record.hash
            if key not in self._versions:
                self._add(key, record)
        for key, version in self._versions.items():
            self._attach(version, {r for r in others if (r.middleware, r.hash) == key})

    def _add(self, key: tuple[str, str], record: PortRecord) -> None:
        shapes = shapes_of_peer(self._at, record, self._shapes_of)
        if shapes is None:
            self._versions[key] = _Version(None, None, set(), {})
            return
        interface = PeerInterface(self._at.interface, record, shapes)
        interface.log_differences(self._at, record)
        port = None
        if any(interface.has(operation) for operation in self._at.interface.published):
            port = self._open(record.middleware, replace(self._at, interface=interface))
        version = self._versions[key] = _Version(port, interface, set(), {})
        for operation, functions in self._bound.values():
            if function := self._bind(version, operation):
                functions.append(function)

    def _bind(self, version: _Version, operation: Operation) -> OperationCallable | None:
        port, interface = version.port, version.interface
        if port is None or interface is None or not interface.has(operation):
            return None
        encode: Any
        send: Any
        counts = OperationCounts(self._at.port, operation.name)
        encode, send = port.publisher.bind(operation, counts)
        numbers = port.numbers
        sequence: Any = numbers.counter(operation.name) if numbers else None

        def publish(*arguments: Any) -> None:
            data = encode(arguments) if encode else arguments
            number = SEQUENCE_FORMAT.pack(numbers.id, next(sequence)) if numbers else b""
            send(data, number)

        version.functions[operation.name] = publish
        return publish

    @staticmethod
    def _attach(version: _Version, records: Collection[PortRecord]) -> None:
        if version.port is None:
            return
        for record in version.attached - set(records):
            version.port.publisher.detach(record)
        for record in set(records) - version.attached:
            version.port.publisher.attach(record)
        version.attached = set(records)

    def has_subscribers(self) -> bool:
        """Whether a version with an operation in common has a subscriber."""
        return any(version.port and version.attached for version in self._versions.values())

    def close(self) -> None:
        """End all publishers."""
        while self._versions:
            self._close(self._versions.popitem()[1])

    def _close(self, version: _Version) -> None:
        for name, function in version.functions.items():
            self._bound[name][1].remove(function)
        if version.port:
            version.port.publisher.close()
            if version.port.numbers:
                version.port.numbers.close()
