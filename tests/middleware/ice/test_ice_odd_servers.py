"""A component of ours calls programs that answer as no server should: the error says why."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from robocomp_dsl.runtime.errors import (
    InterfaceMismatch,
    MalformedMessage,
    MiddlewareError,
    RemoteError,
)
from tests.middleware.ice.peers import Ice, PlainProgram

pytestmark = pytest.mark.peers
EMPTY = bytes.fromhex("060000000101")


class Odd(Ice.Blobject):  # type: ignore[misc]
    """A server that answers as no other."""

    def __init__(self, answer: Callable[[Any], Any]) -> None:
        self.answer = answer

    def ice_invoke(self, _request: bytes, current: Any) -> Any:
        return self.answer(current)


def unexpected_mode(_current: Any) -> Any:
    # What a plain server replies if only one side declares an operation `idempotent`.
    raise Ice.UnknownLocalException("unexpected operation mode. expected = ::Ice::Normal")


def no_operation(current: Any) -> Any:
    raise Ice.OperationNotExistException(current.id, current.facet, current.operation)


def marshal(_current: Any) -> Any:
    raise Ice.UnknownLocalException("InputStream.cpp:1: Ice::UnmarshalOutOfBoundsException:")


@pytest.mark.parametrize(
    ("answer", "error", "message"),
    [
        (unexpected_mode, InterfaceMismatch, r"plain \(odd:.*only one of the two .*`idempotent`"),
        (no_operation, InterfaceMismatch, r"plain \(odd:.*has no operation of this name"),
        (marshal, InterfaceMismatch, "disagree about parameters or types; compare its Slice file"),
        (lambda _: (True, EMPTY), MalformedMessage, r"reply of plain\.Store\.list.*4 bytes exp"),
        (lambda _: (True, b""), (MalformedMessage, RemoteError), "plain.Store.list"),
        (lambda _: (False, EMPTY), MalformedMessage, r"reply of plain\.Store\.list"),
    ],
)
def test_odd_answers_of_plain_server_are_explained(
    plain: Callable[..., PlainProgram],
    connect: Callable[[str], SimpleNamespace],
    answer: Callable[[Any], Any],
    error: Any,
    message: str,
) -> None:
    proxy = connect(plain().serve(Odd(answer), "odd")).proxy
    with pytest.raises(error, match=message):
        proxy.list_(1)


def test_idempotent_mismatch_of_real_server_is_explained(
    plain: Callable[..., PlainProgram],
    connect: Callable[[str], SimpleNamespace],
    generated: Any,
    tmp_path: Any,
) -> None:
    file = tmp_path / "Other.ice"
    file.write_text(
        "module RoboCompOtherStore { interface Store { idempotent int list(int number); }; };"
    )
    Ice.loadSlice(str(file))
    import RoboCompOtherStore  # noqa: PLC0415

    class Servant(RoboCompOtherStore.Store):  # type: ignore[misc, name-defined]
        def list(self, number: int, current: Any = None) -> int:
            return number

    proxy = connect(plain().serve(Servant(), "store")).proxy
    with pytest.raises(InterfaceMismatch, match="only one of the two sides declares"):
        proxy.list_(1)


def test_server_that_is_no_ice_program_is_reported(
    connect: Callable[[str], SimpleNamespace],
) -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]

        def answer() -> None:
            peer, _ = listener.accept()
            with peer:
                peer.sendall(b"HTTP/1.0 400 Bad Request\r\n\r\n")

        thread = threading.Thread(target=answer)
        thread.start()
        proxy = connect(f"store:tcp -h localhost -p {port}").proxy
        with pytest.raises(MiddlewareError, match=r"store:tcp|plain\.Store"):
            proxy.list_(1)
        thread.join(30)
