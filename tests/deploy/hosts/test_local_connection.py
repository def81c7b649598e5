"""This machine as a host of a deployment."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.hosts.connection import Upload, connect
from robocomp_dsl.deploy.hosts.errors import HostTimeout, HostWriteError
from robocomp_dsl.model.deployment import Host

HERE = Host("here", "localhost")
NOISY = """\
import sys
input()
sys.stderr.write("x" * 3_000_000 + "last words")
sys.stderr.flush()
print("y" * 3_000_000)
print("end")
sys.exit(5)
"""
"""Writes more than a pipe holds, and errors first."""


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


def run(task: Coroutine[Any, Any, Any]) -> Any:
    return asyncio.run(asyncio.wait_for(task, 120))


def test_local_connection_runs_commands(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("XDG_RUNTIME_DIR", "DBUS_SESSION_BUS_ADDRESS"):
        monkeypatch.delenv(name, raising=False)

    async def session() -> None:
        connection = await connect(HERE)
        script = "pwd; id -u; echo $XDG_RUNTIME_DIR $DBUS_SESSION_BUS_ADDRESS; echo no >&2; exit 4"
        result = await connection.run(["sh", "-c", script])
        folder, uid, environment = result.text.splitlines()
        assert folder == str(home)
        assert environment == f"/run/user/{uid} unix:path=/run/user/{uid}/bus"
        assert (result.code, result.error) == (4, "no")
        assert (await connection.run(["cat"], input=b"x" * 200_000)).stdout == b"x" * 200_000
        assert (await connection.run(["cat"])).stdout == b""
        assert (await connection.run(["sh", "-c", "kill -9 $$"])).code == 137
        assert (await connection.run(["no-such-program"])).code == 127
        with pytest.raises(HostTimeout, match=r"`here` \(this machine\): `sleep` did not end"):
            await connection.run(["sleep", "60"], timeout_s=0.1)
        chunks = connection.stream(["sh", "-c", "echo first; cat; echo second"])
        assert b"".join([chunk async for chunk in chunks]) == b"first\nsecond\n"
        process = await connection.start(["cat"])
        await process.write(b"line\n")
        assert await process.readline() == b"line\n"
        assert (await process.close()).code == 0
        noisy = await connection.start([sys.executable, "-c", NOISY])
        await noisy.write(b"go\n")
        assert len(await noisy.readline()) == 3_000_001
        ended = await noisy.close()
        assert (ended.code, ended.stdout) == (5, b"end\n")
        assert ended.stderr.endswith(b"last words")
        await connection.close()

    run(session())


def test_local_connection_writes_files_at_once(home: Path, tmp_path: Path) -> None:
    source = tmp_path / "source"
    source.write_bytes(b"from a file")

    async def session() -> None:
        connection = await connect(HERE)
        assert await connection.read("missing") is None
        await connection.write("folder/file", b"first", 0o600)
        assert (home / "folder/file").stat().st_mode & 0o777 == 0o600
        await connection.upload([Upload(source, "folder/file", 0o755), Upload(b"b", "other")])
        assert await connection.read("folder/file") == b"from a file"
        assert (home / "folder/file").stat().st_mode & 0o777 == 0o755
        assert sorted(p.name for p in (home / "folder").iterdir()) == ["file"]
        with pytest.raises(HostWriteError, match="cannot write other/x: "):
            await connection.write("other/x", b"")
        with pytest.raises(HostWriteError, match="cannot read folder: Is a directory"):
            await connection.read("folder")

    run(session())
