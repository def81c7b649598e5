"""The embedded name server replies as YARP's does; the client reads YARP's files and replies."""

from __future__ import annotations

import socket
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress, parse_address
from robocomp_dsl.runtime.middleware.yarp.name_client import (
    NameClient,
    NameServerLost,
    name_server_address,
)
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer, main, start_unless_running
from robocomp_dsl.runtime.middleware.yarp.outgoing import ask_admin
from tests.middleware.yarp.conftest import LOOPBACK

END = "*** end of message"


def ask(server: NameServer, *requests: str) -> list[str]:
    """The lines of the replies; all requests are sent over one connection."""
    with socket.create_connection((LOOPBACK, server.number), 60.0) as client:
        file = client.makefile("rw", newline="\r\n")
        lines = []
        for request in requests:
            file.write(f"NAME_SERVER {request}\n")
            file.flush()
            while (line := file.readline().rstrip("\r\n")) != END:
                lines.append(line)
        return lines


@pytest.mark.parametrize(
    ("request_", "reply"),
    [
        ("query /fake", ["registration name /fake ip 127.0.0.1 port 12345 type tcp"]),
        ("query /nope", []),
        ("nonsense", []),
        ("", []),
        ("register /x", ["registration name /x ip 127.0.0.1 port 10002 type tcp"]),
        ("register ...", ["registration name /tmp/port/1 ip 127.0.0.1 port 10002 type tcp"]),
        ("register /x tcp ... ...", ["registration name /x ip 127.0.0.1 port 10002 type tcp"]),
        ("register /x mcast ... ...", ["registration name /x ip 224.1.1.1 port 10002 type mcast"]),
        (
            "register /x tcp 10.0.0.1 99999999",
            ["registration name /x ip 10.0.0.1 port 10002 type tcp"],
        ),
        ("unregister /fake", []),
        ("list /fake", ["registration name /fake ip 127.0.0.1 port 12345 type tcp"]),
        ("list /fa", []),
        ("set /fake offers tcp local mcast", ["port /fake property offers = local mcast tcp"]),
        ("set /nope key v", []),
        ("get /fake key", ["port /fake property key ="]),
        ("get /nope key", []),
        ("check /fake key v", ["port /fake property key value v present false"]),
        ("route /fake /root", ["port /fake route /root = tcp://root"]),
    ],
)
def test_name_server_replies_as_yarp(
    name_server: NameServer, request_: str, reply: list[str]
) -> None:
    assert ask(name_server, "register /fake tcp 127.0.0.1 12345")
    assert ask(name_server, request_) == reply


def test_name_server_lists_sorted_ports(name_server: NameServer) -> None:
    lines = ask(name_server, "register /auto tcp 127.0.0.1 5", "list")[1:]
    assert lines == [
        "registration name /auto ip 127.0.0.1 port 5 type tcp",
        f"registration name /root ip 127.0.0.1 port {name_server.number} type tcp",
        "registration name fallback ip 224.2.1.1 port 10000 type mcast",
    ]


def test_name_server_is_a_port(name_server: NameServer) -> None:
    root = PortAddress("/root", "text_ack", LOOPBACK, name_server.number)
    assert list(ask_admin(root, "admin", ["ver"], 60.0))[1:] == [1, 2, 3]
    with socket.create_connection(root.socket, 60.0) as client:
        client.sendall(b"CONNACK me\r\nd\r\nbot query /root\r\nd\r\nbot query /no\r\nq\r\n")
        text = client.makefile().read()
    number = name_server.number
    assert f'port (name "/root") (ip "127.0.0.1") (port_number {number}) (carrier tcp)' in text
    assert 'port (error -2 "port not known")' in text


def test_client_registers_and_queries(names: NameClient) -> None:
    assert names.query("/own") is None
    names.register("/own", LOOPBACK, 5)
    assert names.query("/own", "fast_tcp") == PortAddress("/own", "fast_tcp", LOOPBACK, 5)
    names.unregister("/own")
    assert names.query("/own") is None


def test_client_reports_a_lost_name_server(name_server: NameServer) -> None:
    client = NameClient((LOOPBACK, name_server.number))
    name_server.close()
    with pytest.raises(NameServerLost, match="Connection refused"):
        client.query("/own")


def test_one_of_two_name_servers_starts(name_server: NameServer) -> None:
    assert start_unless_running((LOOPBACK, name_server.number)) is None
    name_server.close()
    second = start_unless_running((LOOPBACK, name_server.number))
    assert second is not None
    second.close()


def test_address_of_another_program_is_reported(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.create_server((LOOPBACK, 0)) as other:
        at = f"{LOOPBACK}:{other.getsockname()[1]}"
        assert main(["--at", at]) == 1
    assert capsys.readouterr().err == (
        f"error: YARP cannot listen at {at}: Address already in use\n"
    )


@pytest.mark.parametrize(
    ("text", "environment", "address"),
    [
        ("10.0.0.2 10005 yarp\n", {}, ("10.0.0.2", 10005)),
        ("10.0.0.2\n10005\n", {}, ("10.0.0.2", 10005)),
        ("nonsense", {}, ("127.0.0.1", 10000)),
        ("h 99999999 yarp", {}, ("127.0.0.1", 10000)),
        ("", {"YARP_NAMESPACE": "/foo/bar"}, ("10.0.0.9", 10888)),
    ],
)
def test_name_server_address_of_yarp_conf(
    tmp_path: Path, text: str, environment: dict[str, str], address: tuple[str, int]
) -> None:
    (tmp_path / "yarp.conf").write_text(text)
    (tmp_path / "_foo_bar.conf").write_text("10.0.0.9 10888 yarp\n")
    environment = {"YARP_CONFIG_HOME": str(tmp_path), **environment}
    assert name_server_address("", environment) == address
    assert name_server_address("h:5", environment) == ("h", 5)


@pytest.mark.parametrize("home", ["XDG_CONFIG_HOME", "HOME"])
def test_name_server_address_of_usual_folders(tmp_path: Path, home: str) -> None:
    folder = tmp_path / ("yarp" if home == "XDG_CONFIG_HOME" else ".config/yarp")
    folder.mkdir(parents=True)
    (folder / "yarp.conf").write_text("h 7 yarp")
    assert name_server_address("", {home: str(tmp_path)}) == ("h", 7)


@pytest.mark.parametrize("setting", ["10000", "h:0", "h:99999", "h:5:6", "a b:5"])
def test_name_server_address_refuses_other_settings(setting: str) -> None:
    with pytest.raises(MiddlewareError, match="write HOST:PORT, such as"):
        name_server_address(setting, {})


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("/laser:o", PortAddress("/laser:o")),
        ("tcp://laser:o", PortAddress("/laser:o")),
        ("fast_tcp:/a/b:o", PortAddress("/a/b:o", "fast_tcp")),
        ("text:/a@h:5", PortAddress("/a", "text", "h", 5)),
        ("tcp:/a@[::1]:5", PortAddress("/a", "tcp", "[::1]", 5)),
    ],
)
def test_parse_address(text: str, address: PortAddress) -> None:
    assert parse_address(text, "own.Laser") == address
    assert parse_address(str(address), "own.Laser") == address


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("laser", "`laser` is no address of YARP; write a name such as"),
        ("/a@h", "is no address of YARP"),
        ("/a@h:99999", "is no address of YARP"),
        ("udp:/a", "the carrier `udp` is not supported; known: tcp, fast_tcp, text, text_ack"),
        ("//", "names no port"),
    ],
)
def test_parse_address_refuses(text: str, message: str) -> None:
    with pytest.raises(MiddlewareError, match=message):
        parse_address(text, "own.Laser")


def test_table_limits_its_ports(name_server: NameServer, monkeypatch: Any) -> None:
    from robocomp_dsl.runtime.middleware.yarp import registrations  # noqa: PLC0415

    monkeypatch.setattr(registrations, "MAX_PORTS", 3)
    assert ask(name_server, "register /a tcp h 5")
    assert ask(name_server, "register /b tcp h 6") == []
    assert ask(name_server, "register /a tcp h 7")
