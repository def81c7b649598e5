"""TCP ports of loopback ask for the token of the user."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest
import zenoh

from robocomp_dsl.runtime.presence.domain_session import DomainSession, open_session
from robocomp_dsl.runtime.private_folder import USER, read_token, token_file, user_folder
from tests.middleware.network import Network

ROOT = Path(__file__).parents[2]
VALUE = b"position"


@pytest.fixture
def served() -> Iterator[tuple[DomainSession, int]]:
    """A session with a TCP port that answers every query, and the port."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    opened = open_session(Network("zenoh").domain, port)
    queryable = opened.session.declare_queryable("rc/x", lambda query: query.reply("rc/x", VALUE))
    yield opened, port
    queryable.undeclare()
    opened.close()


def ask(port: int, user: str = "", password: str = "") -> list[bytes]:
    """The answers that a zenoh program gets at the port. Raises `ZError` if it is refused."""
    config = zenoh.Config()
    settings: dict[str, object] = {
        "mode": "client",
        "connect/endpoints": [f"tcp/127.0.0.1:{port}"],
        "connect/timeout_ms": 0,
        "scouting/multicast/enabled": False,
    }
    if user:
        settings |= {
            "transport/auth/usrpwd/user": user,
            "transport/auth/usrpwd/password": password,
        }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    with zenoh.open(config) as session:
        return [r.ok.payload.to_bytes() for r in session.get("rc/x", timeout=60.0) if r.ok]


def test_port_answers_a_program_with_the_token(served: tuple[DomainSession, int]) -> None:
    token = read_token(user_folder())
    assert ask(served[1], USER, token) == [VALUE]


@pytest.mark.parametrize(
    ("user", "password"),
    [("", ""), (USER, "0" * 32), ("root", "TOKEN"), (USER, "TOKEN0"), (USER, "")],
    ids=["no token", "wrong token", "wrong user", "too long", "empty"],
)
def test_port_refuses_a_program_without_the_token(
    served: tuple[DomainSession, int], user: str, password: str
) -> None:
    token = read_token(user_folder())
    with pytest.raises(zenoh.ZError):
        ask(served[1], user, password.replace("TOKEN", token))
    assert ask(served[1], USER, token) == [VALUE]


def test_how_to_configuration_connects(served: tuple[DomainSession, int]) -> None:
    text = (ROOT / "docs/how-to/connect_over_tcp.md").read_text()
    example = text.partition("```json5\n")[2].partition("```")[0]
    config = zenoh.Config.from_json5(
        example.replace("7451", str(served[1])).replace(
            "0123456789abcdef0123456789abcdef", read_token(user_folder())
        )
    )
    with zenoh.open(config) as session:
        assert [r.ok.payload.to_bytes() for r in session.get("rc/x", timeout=60.0) if r.ok]


def test_port_survives_random_bytes(served: tuple[DomainSession, int]) -> None:
    for data in (b"", b"GET / HTTP/1.1\r\n\r\n", os.urandom(70_000)):
        with socket.create_connection(("127.0.0.1", served[1])) as peer:
            peer.sendall(data)
    assert ask(served[1], USER, read_token(user_folder())) == [VALUE]


def test_token_file_is_private_and_stays(served: tuple[DomainSession, int]) -> None:
    path = token_file(user_folder())
    assert path.stat().st_mode & 0o777 == 0o600
    assert path.parent.stat().st_mode & 0o777 == 0o700
    assert path.parent == served[0].socket.parent.parent
    assert read_token(user_folder()) == read_token(user_folder())
    assert [p.name for p in Path(path.parent).glob("token*")] == ["token"]
