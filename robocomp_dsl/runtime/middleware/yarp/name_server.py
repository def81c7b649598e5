"""A name server of YARP: `python -m robocomp_dsl.runtime.middleware.yarp.name_server`.

In: requests of ports and tools, over name_ser or any carrier of a port. Out: where ports listen.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import threading
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any

from robocomp_dsl.runtime.codec.bottle.from_bottle import as_items
from robocomp_dsl.runtime.codec.bottle.text_writer import write_value
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage, MiddlewareError
from robocomp_dsl.runtime.middleware.yarp.name_client import (
    END,
    NameClient,
    NameServerLost,
    name_server_address,
)
from robocomp_dsl.runtime.middleware.yarp.port import YarpPort
from robocomp_dsl.runtime.middleware.yarp.registrations import Registered, RegistrationTable
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream

_PREFIX = "NAME_SERVER"
_NOT_KNOWN: list[Any] = ["port", ["error", -2, "port not known"]]


class NameReceiver:
    """Replies to requests that arrive as Bottles."""

    def __init__(self, table: RegistrationTable) -> None:
        self._table = table

    def receive(
        self, bottle: Bottle, size: int, envelope: str, *, wants_reply: bool
    ) -> Bottle | None:
        """See `port.Receiver`."""
        del size, envelope, wants_reply
        words = [item if isinstance(item, str) else write_value(item) for item in as_items(bottle)]
        if words[:1] == [_PREFIX]:
            words = words[1:]
        if words[:1] == ["bot"]:
            return self._structured(words[1:])
        lines = self._table.reply(words, "127.0.0.1")
        return ["\n".join([*lines, END])]

    def _structured(self, words: list[str]) -> list[Any]:
        if words[:1] == ["list"]:
            found = self._table.found(words[1] if len(words) > 1 else "")
            return ["ports", *(["port", *_described(port)] for port in found)]
        self._table.reply(words, "127.0.0.1")
        name = words[1] if len(words) > 1 else ""
        for port in self._table.found(name):
            if port.name == name:
                return ["port", *_described(port)]
        return _NOT_KNOWN

    def reject(self, error: MalformedMessage) -> Bottle:
        """See `port.Receiver`."""
        return ["error", str(error)]

    def unwritable(self, error: EncodeError) -> Bottle:
        """See `port.Receiver`."""
        return ["error", str(error)]


def _described(port: Registered) -> list[Any]:
    return [
        ["name", port.name],
        ["ip", port.host],
        ["port_number", port.number],
        ["carrier", port.carrier],
    ]


class NameServer(YarpPort):
    """A running name server. Raises `MiddlewareError` if it cannot listen."""

    def __init__(self, at: tuple[str, int]) -> None:
        name = os.environ.get("YARP_NAMESPACE") or "/root"
        self._table_ready = threading.Event()
        super().__init__(name, at)
        self.table = RegistrationTable(name, at[0], self.number)
        self.receiver = NameReceiver(self.table)
        self._table_ready.set()

    def name_requests(self, stream: YarpStream) -> Callable[[], None]:
        """See `YarpPort`."""

        def serve() -> None:
            self._table_ready.wait()
            caller = stream.socket.getpeername()[0]
            line = "NAME_SER" + stream.line()
            while True:
                words = line.split()
                lines = self.table.reply(words[1:], caller) if words[:1] == [_PREFIX] else []
                text = "".join(f"{each}\r\n" for each in (*lines, END))
                stream.send(text.encode(errors="surrogateescape"))
                line = stream.line()

        return serve


def start_unless_running(at: tuple[str, int]) -> NameServer | None:
    """A name server in this process; None if one answers at the address already.

    Raises `MiddlewareError` if another program has the address.
    """
    client = NameClient(at)
    try:
        client.query("/root")
    except NameServerLost:
        try:
            return NameServer(at)
        except MiddlewareError:
            try:  # another component started one at the same time
                client.query("/root")
            except NameServerLost:
                pass
            else:
                return None
            raise
    return None


def main(arguments: list[str] | None = None) -> int:
    """Run a name server until a signal ends it; returns the exit code."""
    parser = argparse.ArgumentParser(prog="name_server", description="A name server of YARP.")
    parser.add_argument(
        "--at",
        metavar="HOST:PORT",
        default="",
        help="where to listen; default: as in yarp.conf, else 127.0.0.1:10000",
    )
    chosen = parser.parse_args(arguments)
    try:
        server = NameServer(name_server_address(chosen.at))
    except MiddlewareError as error:
        sys.stderr.write(f"error: {error}\n")
        return 1
    # A handler may interrupt `SimpleQueue.get`; in `threading.Event.wait` it would deadlock.
    signals: SimpleQueue[int] = SimpleQueue()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: signals.put(number))
    sys.stdout.write(f"name server {server.name} at {server.host}:{server.number}\n")
    sys.stdout.flush()
    signals.get()
    server.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
