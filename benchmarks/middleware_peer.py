"""The other process: answers and echoes, by raw zenoh and by the runtime, until its input ends.

python -m benchmarks.middleware_peer DOMAIN MIDDLEWARE...
"""

from __future__ import annotations

import sys
import threading
from typing import Any

import zenoh

from benchmarks.pose_interface import MOVER, TRACK, Pose, TrackProxy
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.presence.domain_session import open_session


def drain(handler: Any, act: Any) -> None:
    """Handle everything in a thread, as fast as raw code can."""

    def work() -> None:
        try:
            while True:
                act(handler.recv())
        except zenoh.ZError:
            pass

    threading.Thread(target=work, daemon=True).start()


def serve_raw(session: zenoh.Session, ready: bytes) -> list[Any]:
    """A queryable and an echo that send ready bytes."""

    def answer(query: zenoh.Query) -> None:
        query.payload.to_bytes()
        query.reply("raw/query", ready)
        query.drop()

    back = session.declare_publisher("raw/back")

    def echo(sample: zenoh.Sample) -> None:
        sample.payload.to_bytes()
        back.put(ready)

    queryable = session.declare_queryable("raw/query", zenoh.handlers.FifoChannel(256))
    subscriber = session.declare_subscriber("raw/there", zenoh.handlers.FifoChannel(256))
    drain(queryable.handler, answer)
    drain(subscriber.handler, echo)
    return [queryable, subscriber, back]


def serve_generated(middleware: str, domain: str) -> Any:
    """A component `peer-MIDDLEWARE` that answers and echoes."""
    execution, name = CallbackGroup(), f"peer-{middleware}"
    ports = open_ports(middleware, ComponentContext(name, domain, execution, Statistics()))
    mover = Endpoint(MOVER, name, "Mover", middlewares=(middleware,))
    ports.serve(mover, {"move": lambda pose: pose}, execution)
    back = TrackProxy(ports.advertise(Endpoint(TRACK, name, "Back", middlewares=(middleware,))))
    there = Endpoint(TRACK, name, "There", (f"client-{middleware}",), middlewares=(middleware,))
    ports.subscribe(there, {"moved": back.moved}, execution)
    return ports


def main(domain: str, *middlewares: str) -> None:
    """Serve both ways."""
    raw = open_session(domain)
    raw_server = serve_raw(raw.session, MOVER.operations[0].encode_reply(Pose()))
    opened = [serve_generated(middleware, domain) for middleware in middlewares]
    print("ready", flush=True)
    sys.stdin.read()
    for ports in opened:
        ports.close()
    raw.close()
    del raw_server


if __name__ == "__main__":
    main(*sys.argv[1:])
