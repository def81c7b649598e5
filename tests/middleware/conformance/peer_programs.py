"""The components that run in other processes. Each prints `ready`, then answers its input."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from typing import Any

# Imported before the fork.
import robocomp_dsl.runtime.presence.zenoh_presence  # noqa: F401
from robocomp_dsl.runtime.connection.endpoint import Qos
from tests.middleware.network import Network
from tests.middleware.probe_handlers import HANDLERS


def serve(middleware: str, domain: str, name: str = "server", result: int = 0) -> None:
    """Serve `Probe`; `add` returns `result` if it is not 0. `close`: end the component in order."""
    network = Network(middleware, domain)
    node = network.node(name)
    handlers: dict[str, Callable[..., Any]] = {**HANDLERS, "block": threading.Event().wait}
    if result:
        handlers["add"] = lambda _a, _b: result
    node.serve(handlers)
    _answer({"close": lambda: network.close() or "closed", "calls": lambda: _calls(node)})


def _calls(node: Any) -> int:
    return sum(counts.calls for counts in node.statistics.operations.values())


def subscribe(
    middleware: str, domain: str, name: str = "subscriber", qos: dict[str, Any] | None = None
) -> None:
    """Subscribe to `News`. `count`: messages that have arrived; `last`: the last number; `lost`."""
    network = Network(middleware, domain)
    received: list[tuple[str, int]] = []
    node = network.node(name)
    node.subscribe(lambda who, n: received.append((who, n)), qos=Qos(**(qos or {})))

    def count_losses() -> int:
        node.statistics.refresh()
        return int(node.count("announced", "News").drops)

    _answer(
        {
            "count": lambda: len(received),
            "last": lambda: received[-1][1] if received else -1,
            "lost": count_losses,
        }
    )


def publish(middleware: str, domain: str, name: str = "publisher") -> None:
    """Publish `News` for ever. `count`: how many messages were published."""
    network = Network(middleware, domain)
    news = network.node(name).news()
    published = 0

    def run() -> None:
        nonlocal published
        while True:
            news.announced(name, published)
            published += 1

    threading.Thread(target=run, daemon=True).start()
    _answer({"count": lambda: published})


def call(middleware: str, domain: str, name: str = "caller", peer: str = "server") -> None:
    """Call an operation of `peer` that waits."""
    network = Network(middleware, domain)
    probe = network.node(name).probe(peer)
    assert probe.add(1, 1) == 2
    threading.Thread(target=probe.block, daemon=True).start()
    _answer({"close": lambda: network.close() or "closed"})


def _answer(replies: dict[str, Callable[[], object]]) -> None:
    """Reply to each line until the end of standard input."""
    sys.stdin = open(0, closefd=False)  # noqa: SIM115 - the one before the fork has a buffer
    _print("ready")
    for line in sys.stdin:
        _print(replies[line.strip()]())


def _print(reply: object) -> None:
    sys.stdout.write(f"{reply}\n")
    sys.stdout.flush()


PROGRAMS: dict[str, Callable[..., None]] = {
    "serve": serve,
    "subscribe": subscribe,
    "publish": publish,
    "call": call,
}
