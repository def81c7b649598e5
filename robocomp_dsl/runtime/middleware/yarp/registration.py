"""Keeps the ports of a component known to the name server, and its inputs connected.

In: own ports, and the external publishers of subscribed ports. Out: registrations and `[add]`
requests, repeated by one thread when the name server or a publisher was restarted.
"""

from __future__ import annotations

import logging
import threading
from dataclasses import dataclass, field

from robocomp_dsl.runtime.codec.bottle.values import vocab
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.yarp import outgoing
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient, NameServerLost
from robocomp_dsl.runtime.middleware.yarp.outgoing import Resolve
from robocomp_dsl.runtime.middleware.yarp.port import YarpPort

INTERVAL_S = 0.5
"""The name server and the publishers are checked so often."""
ASK_S = 2.0
log = logging.getLogger("robocomp")


@dataclass(eq=False, slots=True)
class _Registered:
    """A port of this component, and the publishers that it is connected to."""

    port: YarpPort
    publishers: list[PortAddress] = field(default_factory=list)
    is_known: bool = False
    is_taken: bool = False
    refused: set[str] = field(default_factory=set)


class Registration:
    """The ports of one component at one name server."""

    def __init__(self, names: NameClient, resolve: Resolve) -> None:
        self._names = names
        self._resolve = resolve
        self._lock = threading.Lock()
        self._ports: list[_Registered] = []
        self._changed = threading.Event()
        self._closed = False
        self._is_lost = False
        self._thread: threading.Thread | None = None

    def add(self, port: YarpPort, publishers: list[PortAddress] | None = None) -> None:
        """Register a port from now on; never blocks."""
        with self._lock:
            self._ports.append(_Registered(port, publishers or []))
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="yarp names", daemon=True)
                self._thread.start()
        self._changed.set()

    def remove(self, port: YarpPort) -> None:
        """Forget a port."""
        with self._lock:
            found = [each for each in self._ports if each.port is port]
            self._ports = [each for each in self._ports if each.port is not port]
        for each in found:
            if each.is_known and not self._is_lost:
                try:
                    self._names.unregister(port.name)
                except NameServerLost as error:
                    log.debug("%s stays registered: %s", port.name, error)

    def _run(self) -> None:
        while not self._closed:
            self._changed.clear()
            with self._lock:
                ports = list(self._ports)
            try:
                for each in ports:
                    self._register(each)
            except NameServerLost as error:
                self._name_server_lost(error, ports)
            else:
                if self._is_lost:
                    log.info("the name server of YARP replies")
                self._is_lost = False
            for each in ports:
                self._connect_publishers(each)
            self._changed.wait(INTERVAL_S)

    def _register(self, registered: _Registered) -> None:
        """Register a port if the name server does not know it. Raises `NameServerLost`."""
        port = registered.port
        found = self._names.query(port.name)
        if found is not None and (found.host, found.number) == (port.host, port.number):
            registered.is_known = True
            return
        if found is not None and registered.is_known:
            if not registered.is_taken:
                log.warning(
                    "another program has registered the port %s, at %s:%d",
                    *(port.name, found.host, found.number),
                )
            registered.is_taken = True
            return
        self._names.register(port.name, port.host, port.number)
        registered.is_known, registered.is_taken = True, False
        with self._lock:
            is_removed = registered not in self._ports
        if is_removed:
            self._names.unregister(port.name)

    def _name_server_lost(self, error: NameServerLost, ports: list[_Registered]) -> None:
        if not self._is_lost and not self._closed:
            log.warning(
                "the name server of YARP cannot be reached at %s; other components find the ports,"
                " programs of YARP do not. Start `yarpserver`, or"
                " `python -m robocomp_dsl.runtime.middleware.yarp.name_server`",
                error,
            )
        self._is_lost = True
        for each in ports:
            each.is_known = False

    def _connect_publishers(self, registered: _Registered) -> None:
        """Ask the publishers that send nothing to connect, as `yarp connect` does."""
        if not registered.publishers:
            return
        port = registered.port
        inputs = port.inputs()
        for publisher in registered.publishers:
            if self._closed:
                return
            is_connected = publisher.name in inputs
            failure = "" if is_connected else self._ask_to_connect(port, publisher)
            if failure and publisher.name not in registered.refused:
                registered.refused.add(publisher.name)
                log.warning("%s is not connected to %s: %s", port.name, publisher.name, failure)
            elif not failure and publisher.name in registered.refused:
                registered.refused.discard(publisher.name)
                log.info("%s is connected to %s", port.name, publisher.name)

    def _ask_to_connect(self, port: YarpPort, publisher: PortAddress) -> str:
        """Why a publisher cannot send to `port`; empty if it does."""
        target = f"{publisher.carrier}:/{port.name}"
        try:
            at = self._resolve(publisher)
            reply = outgoing.ask_admin(at, "admin", [vocab("add"), target], ASK_S)
        except ConnectionLost as error:
            return str(error)
        if len(reply) and reply[0] == 0:
            return ""
        return str(reply[1]).strip() if len(reply) > 1 else "it does not reply"

    def close(self) -> None:
        """Check nothing more."""
        self._closed = True
        self._changed.set()
        if self._thread:
            self._thread.join(1.0)
