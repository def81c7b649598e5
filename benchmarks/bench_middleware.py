"""Calls through the runtime against the same calls by hand, in turns, in one run.

Over zenoh to another process; the raw code sends bytes that are ready, as the runtime does it with
sessions, channels and threads of the same kind. In-process against a plain method call.
"""

from __future__ import annotations

import subprocess
import sys
import threading
import uuid
from collections.abc import Callable
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
from robocomp_dsl.runtime.presence.domain_session import open_session

ROUNDS = 60
CALLS = 100


def once(call: Callable[[], Any]) -> float:
    """Median of `CALLS` calls, in us."""
    took = []
    for _ in range(CALLS):
        start = perf_counter_ns()
        call()
        took.append(perf_counter_ns() - start)
    return median(took) / 1000


def in_turns(calls: dict[str, Callable[[], Any]]) -> dict[str, list[float]]:
    """The medians of every round of every call; the order changes from round to round."""
    took: dict[str, list[float]] = {name: [] for name in calls}
    names = list(calls)
    for number in range(ROUNDS):
        for name in names if number % 2 else reversed(names):
            took[name].append(once(calls[name]))
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
        """Let the one who waits go on."""
        self._lock.release()

    def wait(self) -> None:
        """Until it rings."""
        assert self._lock.acquire(timeout=5)


def over_zenoh() -> list[dict[str, Any]]:
    """Query and publish round trips."""
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    with subprocess.Popen(
        [sys.executable, "-m", "benchmarks.middleware_peer", domain],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as peer:
        assert peer.stdout
        peer.stdout.readline()
        raw = open_session(domain)
        host = ComponentContext("client", domain, CallbackGroup(), Statistics())
        middleware = open_ports("zenoh", host)
        try:
            took = in_turns(_calls(raw.session, middleware, host))
        finally:
            middleware.close()
            raw.close()
            assert peer.stdin
            peer.stdin.close()
    return [
        {"name": "raw query round trip", "value": median(took["raw query"]), "unit": "us"},
        {"name": "generated query round trip", "value": median(took["query"]), "unit": "us"},
        {
            "name": "generated query / raw query",
            "value": ratio(took, "query", "raw query"),
            "unit": "x",
            "goal": 1.10,
        },
        {"name": "raw publish round trip", "value": median(took["raw publish"]), "unit": "us"},
        {"name": "generated publish round trip", "value": median(took["publish"]), "unit": "us"},
        {
            "name": "generated publish round trip / raw",
            "value": ratio(took, "publish", "raw publish"),
            "unit": "x",
            "goal": 1.20,
        },
    ]


def _calls(
    session: zenoh.Session, middleware: Any, host: ComponentContext
) -> dict[str, Callable[[], Any]]:
    pose = Pose()
    ready = MOVER.operations[0].encode_request((pose,))
    querier = session.declare_querier("raw/query")
    there = session.declare_publisher("raw/there")
    raw_bell, bell = Bell(), Bell()

    def rung(sample: zenoh.Sample) -> None:
        sample.payload.to_bytes()
        raw_bell.ring()

    subscriber = session.declare_subscriber("raw/back", zenoh.handlers.FifoChannel(256))
    drain(subscriber.handler, rung)
    mover = MoverProxy(middleware.proxy(Endpoint(MOVER, "client", "Mover")))
    track = TrackProxy(middleware.advertise(Endpoint(TRACK, "client", "There")))
    heard = Endpoint(TRACK, "client", "Back", ("peer",))
    middleware.subscribe(heard, {"moved": bell.ring}, host.callback_group)

    def raw_query() -> None:
        querier.get(payload=ready).recv().ok.payload.to_bytes()

    def raw_publish() -> None:
        there.put(ready)
        raw_bell.wait()

    def publish() -> None:
        track.moved(pose)
        bell.wait()

    host.statistics.of("kept", "").durations = subscriber  # type: ignore[assignment]
    assert track.wait_for_server(10)
    assert mover.wait_for_server(10)
    while not there.matching_status.matching:
        pass
    return {
        "raw query": raw_query,
        "query": lambda: mover.move(pose),
        "raw publish": raw_publish,
        "publish": publish,
    }


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
    return in_process() + over_zenoh()
