"""The other process: answers and echoes, by raw zenoh and by the runtime, until its input ends."""

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


def main(domain: str) -> None:
    """Serve both ways."""
    raw = open_session(domain)
    raw_server = serve_raw(raw.session, MOVER.operations[0].encode_reply(Pose()))
    execution = CallbackGroup()
    middleware = open_ports("zenoh", ComponentContext("peer", domain, execution, Statistics()))
    middleware.serve(Endpoint(MOVER, "peer", "Mover"), {"move": lambda pose: pose}, execution)
    back = TrackProxy(middleware.advertise(Endpoint(TRACK, "peer", "Back")))
    at = Endpoint(TRACK, "peer", "There", ("client",))
    middleware.subscribe(at, {"moved": back.moved}, execution)
    print("ready", flush=True)
    sys.stdin.read()
    middleware.close()
    raw.close()
    del raw_server


if __name__ == "__main__":
    main(sys.argv[1])
