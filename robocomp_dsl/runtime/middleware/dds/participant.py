"""The DDS participant of a component, and what it discovers of others.

In: the settings of the command line, and topics in use. Out: warnings about endpoints that have
another type under the name of such a topic: DDS delivers nothing between them.
"""

from __future__ import annotations

import contextlib
import logging
import os
import threading
from collections.abc import Iterator, Mapping
from typing import Any

from cyclonedds.builtin import (
    BuiltinDataReader,
    BuiltinTopicDcpsPublication,
    BuiltinTopicDcpsSubscription,
)
from cyclonedds.core import (
    DDSException,
    GuardCondition,
    InstanceState,
    ReadCondition,
    SampleState,
    ViewState,
    WaitSet,
)
from cyclonedds.domain import DomainParticipant
from cyclonedds.util import duration

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.dds.domains import enter_domain, leave_domain
from robocomp_dsl.runtime.middleware.dds.idl_types import dds_type_name
from robocomp_dsl.runtime.middleware.ros_common.settings import domain_id, only_known

SETTINGS = ("domain_id",)
_WAIT_S = 60.0
_BATCH = 100
log = logging.getLogger("robocomp")


class Participant:
    """A participant of a DDS domain; a ROS domain is the DDS domain of the same number."""

    def __init__(self, component: str, settings: Mapping[str, str]) -> None:
        only_known("dds", settings, SETTINGS)
        self.domain_id = domain_id("dds", settings, os.environ)
        self._topics: dict[str, tuple[str, str]] = {}
        self._reported: set[tuple[str, str]] = set()
        self._found: dict[str, set[str]] = {}
        self._lock = threading.Lock()
        self._closed = threading.Event()
        try:
            enter_domain(self.domain_id)
            self.dds: Any = DomainParticipant(self.domain_id)
            self._readers: list[Any] = [
                BuiltinDataReader(self.dds, topic)
                for topic in (BuiltinTopicDcpsPublication, BuiltinTopicDcpsSubscription)
            ]
            self._guard: Any = GuardCondition(self.dds)
            self._waitset: Any = WaitSet(self.dds)
            state = ViewState.Any | InstanceState.Any | SampleState.NotRead
            for reader in self._readers:
                self._waitset.attach(ReadCondition(reader, state))
            self._waitset.attach(self._guard)
        except DDSException as error:
            raise MiddlewareError(
                f"dds: cannot join the DDS domain {self.domain_id}: {error}"
            ) from None
        self._thread = threading.Thread(target=self._discover, name=f"{component} dds", daemon=True)
        self._thread.start()

    @contextlib.contextmanager
    def opening(self, topic: str, port: str) -> Iterator[None]:
        """Raise `MiddlewareError` with the topic and port for a failure of DDS."""
        try:
            yield
        except DDSException as error:
            raise MiddlewareError(f"{port}: DDS cannot open the topic {topic}: {error}") from None

    def watch(self, topic: str, type_id: str, port: str) -> None:
        """Warn of endpoints that use the ROS name `topic` with another type than `type_id`."""
        name, type_name = f"rt{topic}", dds_type_name(type_id)
        with self._lock:
            self._topics[name] = type_name, port
            found = set(self._found.get(name, ()))
        for other in found:
            self._compare(name, other)

    def _discover(self) -> None:
        while not self._closed.is_set():
            try:
                self._waitset.wait(duration(seconds=_WAIT_S))
                samples = [sample for reader in self._readers for sample in reader.take(_BATCH)]
            except DDSException as error:
                if not self._closed.is_set():
                    log.warning("dds: other participants are not discovered: %s", error)
                return
            for sample in samples:
                if sample.sample_info.valid_data:
                    with self._lock:
                        self._found.setdefault(sample.topic_name, set()).add(sample.type_name)
                    self._compare(sample.topic_name, sample.type_name)

    def _compare(self, topic: str, type_name: str) -> None:
        with self._lock:
            expected, port = self._topics.get(topic, (type_name, ""))
            if type_name == expected or (topic, type_name) in self._reported:
                return
            self._reported.add((topic, type_name))
        log.warning(
            "%s: a DDS endpoint uses %s with the type %s, this component with %s",
            port,
            topic.removeprefix("rt"),
            type_name,
            expected,
        )

    def close(self) -> None:
        """Leave the domain."""
        if self._closed.is_set():
            return
        self._closed.set()
        self._guard.set(True)
        self._thread.join(1.0)
        self.dds = self._waitset = self._guard = None  # deleted with their last reference
        self._readers.clear()
        leave_domain(self.domain_id)
