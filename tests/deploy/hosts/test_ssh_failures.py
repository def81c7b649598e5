"""What a user reads when the address of a host leads to no SSH server."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path

import pytest

from robocomp_dsl.deploy.hosts.connection import connect
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.extras import MissingExtra
from robocomp_dsl.model.deployment import Host


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / ".ssh").mkdir()
    return tmp_path


def failure_at(greeting: bytes | None, silence_s: float = 30.0) -> HostError:
    """The error with a TCP server that sends `greeting` and closes, or only listens (None)."""

    async def serve(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        if greeting is not None:
            writer.write(greeting)
            await writer.drain()
            writer.close()

    async def attempt() -> HostError:
        server = await asyncio.start_server(serve, "127.0.0.1", 0)
        port = server.sockets[0].getsockname()[1]
        with pytest.raises(HostError) as caught:
            await connect(Host("arm", "127.0.0.1", "nao", ssh_port=port), silence_s)
        server.close()
        return caught.value

    return asyncio.run(asyncio.wait_for(attempt(), 60))


@pytest.mark.parametrize(
    ("greeting", "message"),
    [
        (b"HTTP/1.1 400 Bad Request\r\n\r\n", "the connection was closed before the login"),
        (b"SSH-1.5-old\r\n", "no SSH server (Unsupported SSH version)"),
        (b"", "the connection was closed before the login"),
        (None, "no answer within 0.2 s"),
    ],
)
def test_ssh_failure_describes_servers(greeting: bytes | None, message: str) -> None:
    error = failure_at(greeting, 0.2 if greeting is None else 30.0)
    assert message in str(error)
    assert str(error).startswith("`arm` (nao@127.0.0.1, port ")
    assert error.code.id == "RC830"
    assert error.help


def test_ssh_failure_describes_errors_in_ssh_config(home: Path) -> None:
    (home / ".ssh/config").write_text("Host *\n  Port many\n", "utf-8")
    error = failure_at(b"")
    assert "~/.ssh/config has an error" in str(error)
    assert error.help == "correct that file"


def test_ssh_failure_describes_broken_key_files(home: Path) -> None:
    (home / ".ssh/broken").write_text("no key", "utf-8")
    (home / ".ssh/config").write_text("Host *\n  IdentityFile ~/.ssh/broken\n", "utf-8")
    assert "an SSH key of yours cannot be read" in str(failure_at(b""))


def test_missing_library_is_reported_before_any_connection(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ssh", "ssh_client"):
        monkeypatch.delitem(sys.modules, f"robocomp_dsl.deploy.hosts.{name}", raising=False)
    monkeypatch.setitem(sys.modules, "asyncssh", None)
    with pytest.raises(MissingExtra, match=r"pip install 'robocomp_dsl\[hosts\]'"):
        asyncio.run(connect(Host("arm", "10.0.0.2")))
