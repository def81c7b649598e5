"""Calls through the runtime against the same calls by hand, in turns, in one run.

Over every middleware to another process, and over raw zenoh: the raw code sends bytes that are
ready, as the runtime does it with sessions, channels and threads of the same kind. In-process
against a plain method call.
"""

from __future__ import annotations

import subprocess
import sys
import threading
import uuid
from collections.abc import Callable
from functools import partial
from statistics import median
from time import perf_counter_ns
from typing import Any

import zenoh

from benchmarks.middleware_peer import drain
from benchmarks.pose_interface import MOVER, TRACK, MoverProxy, Pose, TrackProxy
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.middleware.registry import known_capabilities, middleware_names
from robocomp_dsl.runtime.presence.domain_session import open_session

ROUNDS = 60
CALLS = 100
GOALS = {"local": 0.25}
"""Of a query, relative to zenoh."""


def once(call: Callable[[], Any]) -> float:
    """Median of `CALLS` calls, in us."""
    took = []
    for _ in range(CALLS):
        start = perf_counter_ns()
        call()
        took.append(perf_counter_ns() - start)
    return median(took) / 1000


def in_turns(
    calls: dict[str, Callable[[], Any]], rounds: dict[str, Callable[[], float]] | None = None
) -> dict[str, list[float]]:
    """The medians of every round of every call; the order changes from round to round.

    `rounds` are functions that make one round elsewhere and return its median.
    """
    every = {name: partial(once, call) for name, call in calls.items()} | (rounds or {})
    took: dict[str, list[float]] = {name: [] for name in every}
    names = list(every)
    for number in range(ROUNDS):
        for name in names if number % 2 else reversed(names):
            took[name].append(every[name]())
    return took


def ratio(took: dict[str, list[float]], above: str, below: str) -> float:
    """Median of the ratios of neighbouring rounds."""
    return median(a / b for a, b in zip(took[above], took[below], strict=True))


class Bell:
    """Something to wait for, as fast as Python can."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._lock.acquire()

    def ring(self, *_: Any) -> None:
        """Let the waiting thread go on."""
        self._lock.release()

    def wait(self) -> None:
        """Until it rings."""
        assert self._lock.acquire(timeout=5)


def between_processes() -> list[str]:
    """The installed middlewares that connect processes, zenoh first."""
    known = {name: known_capabilities(name) for name in middleware_names()}
    for name, capabilities in known.items():
        if capabilities is None:
            print(f"   {name} is not installed: skipped")
    found = [
        name
        for name, c in known.items()
        if c and c.between_processes and c.services and c.topics and not c.ros_types_only
    ]
    return sorted(found, key=lambda name: name != "zenoh")


def over_all() -> list[dict[str, Any]]:
    """Query and publish round trips over every middleware."""
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    middlewares = between_processes()
    with subprocess.Popen(
        [sys.executable, "-m", "benchmarks.middleware_peer", domain, *middlewares],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as peer:
        assert peer.stdout
        peer.stdout.readline()
        raw = open_session(domain)
        clients = {name: Client(name, domain) for name in middlewares}
        try:
            calls = _raw_calls(raw.session)
            for name, client in clients.items():
                calls |= {f"{name} query": client.query, f"{name} publish": client.publish}
            took = in_turns(calls)
        finally:
            for client in clients.values():
                client.ports.close()
            raw.close()
            assert peer.stdin
            peer.stdin.close()
    figures = [
        {"name": f"{name} round trip", "value": median(values), "unit": "us"}
        for name, values in took.items()
    ]
    for title, above, below, goal in (
        ("generated query / raw query, zenoh", "zenoh query", "raw query", 1.10),
        ("generated publish / raw publish, zenoh", "zenoh publish", "raw publish", 1.20),
        *(
            (f"{name} {kind} / zenoh {kind}", f"{name} {kind}", f"zenoh {kind}", goal)
            for name in middlewares[1:]
            for kind, goal in (("query", GOALS.get(name)), ("publish", None))
        ),
    ):
        figures.append({"name": title, "value": ratio(took, above, below), "unit": "x"})
        if goal:
            figures[-1]["goal"] = goal
    return figures


class Client:
    """A component that calls and publishes over one middleware."""

    def __init__(self, middleware: str, domain: str) -> None:
        self._pose = Pose()
        self._bell = Bell()
        name, peer, only = f"client-{middleware}", f"peer-{middleware}", (middleware,)
        group = CallbackGroup()
        self.ports = open_ports(middleware, ComponentContext(name, domain, group, Statistics()))
        mover = Endpoint(MOVER, name, "Mover", (peer,), middlewares=only)
        self._mover = MoverProxy(self.ports.proxy(mover))
        self._track = TrackProxy(
            self.ports.advertise(Endpoint(TRACK, name, "There", middlewares=only))
        )
        back = Endpoint(TRACK, name, "Back", (peer,), middlewares=only)
        self.ports.subscribe(back, {"moved": self._bell.ring}, group)
        assert self._track.wait_for_server(10)
        assert self._mover.wait_for_server(10)

    def query(self) -> None:
        """There and back."""
        self._mover.move(self._pose)

    def publish(self) -> None:
        """There, and back by another topic."""
        self._track.moved(self._pose)
        self._bell.wait()


def _raw_calls(session: zenoh.Session) -> dict[str, Callable[[], Any]]:
    ready = MOVER.operations[0].encode_request((Pose(),))
    querier = session.declare_querier("raw/query")
    there = session.declare_publisher("raw/there")
    raw_bell = Bell()

    def rung(sample: zenoh.Sample) -> None:
        sample.payload.to_bytes()
        raw_bell.ring()

    subscriber = session.declare_subscriber("raw/back", zenoh.handlers.FifoChannel(256))
    drain(subscriber.handler, rung)

    def raw_query() -> None:
        querier.get(payload=ready).recv().ok.payload.to_bytes()

    def raw_publish(_keep: Any = subscriber) -> None:
        there.put(ready)
        raw_bell.wait()

    while not there.matching_status.matching:
        pass
    return {"raw query": raw_query, "raw publish": raw_publish}


def in_process() -> list[dict[str, Any]]:
    """A synchronous call of a component in the same process."""
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    hosts = [
        ComponentContext(name, domain, CallbackGroup(), Statistics())
        for name in ("server", "client")
    ]
    server, client = (open_ports("inproc", host) for host in hosts)
    pose = Pose()

    class Servant:
        def move(self, value: Pose) -> Pose:
            return value

    servant = Servant()
    at = Endpoint(MOVER, "server", "Mover")
    server.serve(at, {"move": servant.move}, hosts[0].callback_group)
    mover = MoverProxy(client.proxy(Endpoint(MOVER, "client", "Mover")))
    mover.move(pose)

    def many(call: Callable[[Pose], Any]) -> float:
        start = perf_counter_ns()
        for _ in range(10_000):
            call(pose)
        return (perf_counter_ns() - start) / 1e7

    above = []
    for _ in range(ROUNDS):
        with hosts[1].callback_group:
            above.append(many(mover.move) - many(servant.move))
    client.close()
    server.close()
    name = "inproc call above a plain method call, from a handler"
    return [{"name": name, "value": median(above), "unit": "us", "goal": 1.0}]


def run() -> list[dict[str, Any]]:
    """All figures."""
    return in_process() + over_all()
