"""Connections to real OpenSSH servers."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path

import pytest

from robocomp_dsl.deploy.hosts.connection import Upload, connect
from robocomp_dsl.deploy.hosts.errors import (
    HostTimeout,
    HostUnreachable,
    HostWriteError,
)
from tests.hosts.connections import host_of, run
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost
from tests.support.waiting import wait_until

NOISY = """\
import sys
input()
sys.stderr.write("x" * 3_000_000 + "last words")
sys.stderr.flush()
print("y" * 3_000_000)
print("end")
sys.exit(5)
"""
"""Writes more than a pipe or a window of SSH holds, and errors first."""


@pytest.fixture(scope="module")
def robot(module_hosts: Hosts) -> SimulatedHost:
    return module_hosts.start("robot")


@pytest.fixture(autouse=True)
def known_robot(module_hosts: Hosts, robot: SimulatedHost, operator: Path) -> None:
    """The person who connects knows the keys of the hosts."""
    module_hosts.trust()


def test_connection_runs_commands(robot: SimulatedHost) -> None:
    async def session() -> None:
        connection = await connect(host_of(robot))
        script = 'echo "$1" $XDG_RUNTIME_DIR; pwd; echo problem >&2; exit 3'
        result = await connection.run(["sh", "-c", script, "sh", "it's $HOME *"])
        assert result.text == f"it's $HOME * /run/user/{robot.uid}\n/home/robot"
        assert (result.code, result.error) == (3, "problem")
        big = os.urandom(300_000)
        assert (await connection.run(["cat"], input=big)).stdout == big
        assert (await connection.run(["cat"])).stdout == b""
        assert (await connection.run(["sh", "-c", "kill -9 $$"])).code == 137
        assert (await connection.run(["no-such-program"])).code == 127
        manager = await connection.run(["systemctl", "--user", "is-system-running"])
        assert manager.text == "running", manager.error
        with pytest.raises(HostTimeout, match=r"`sleep` did not end within 0\.2 s"):
            await connection.run(["sleep", "987"], timeout_s=0.2)
        ended = ["pgrep", "-f", "^sleep 987"]
        wait_until(lambda: robot.run(ended, check=False).returncode, "the command goes on")
        results = await asyncio.gather(*(connection.run(["echo", str(n)]) for n in range(20)))
        assert [result.text for result in results] == [str(n) for n in range(20)]
        await connection.close()
        with pytest.raises(HostUnreachable, match="the connection was lost"):
            await connection.run(["true"])

    run(session())


def test_connection_streams_and_talks(robot: SimulatedHost) -> None:
    async def session() -> None:
        connection = await connect(host_of(robot))
        chunks = connection.stream(["sh", "-c", "echo first; cat; echo second"])
        assert b"".join([chunk async for chunk in chunks]) == b"first\nsecond\n"
        process = await connection.start(["cat"])
        for line in (b"a line\n", b"another\n"):
            await process.write(line)
            assert await process.readline() == line
        result = await process.close()
        assert (result.code, await process.readline()) == (0, b"")
        noisy = await connection.start(["python3", "-c", NOISY])
        await noisy.write(b"go\n")
        assert len(await noisy.readline()) == 3_000_001
        result = await noisy.close()
        assert (result.code, result.stdout) == (5, b"end\n")
        assert result.stderr.endswith(b"last words")
        await connection.close()

    run(session())


def test_connection_copies_files(robot: SimulatedHost, tmp_path: Path) -> None:
    big = tmp_path / "big"
    big.write_bytes(os.urandom(3_000_000))

    async def session() -> None:
        connection = await connect(host_of(robot))
        assert await connection.read("missing") is None
        await connection.write("folder/inner/file", b"first", 0o600)
        await connection.write("folder/inner/file", b"second", 0o755)
        assert await connection.read("folder/inner/file") == b"second"
        uploads = [Upload(str(n).encode(), f"many/{n}/file") for n in range(40)]
        await connection.upload([*uploads, Upload(big, "many/big", 0o640)])
        assert await connection.read("many/39/file") == b"39"
        assert await connection.read("many/big") == big.read_bytes()
        names = (await connection.run(["find", "folder", "many", "-name", "*~"])).text
        assert names == "", "temporary files are left"
        modes = await connection.run(["stat", "-c", "%a", "folder/inner/file", "many/big"])
        assert modes.text.split() == ["755", "640"]
        with pytest.raises(HostWriteError, match="cannot write /etc/x: Permission denied"):
            await connection.write("/etc/x", b"")
        with pytest.raises(HostWriteError, match="cannot read /etc/shadow: Permission denied"):
            await connection.read("/etc/shadow")
        await connection.close()

    run(session())


def test_connection_reports_full_disk(hosts: Hosts, monkeypatch: pytest.MonkeyPatch) -> None:
    small = hosts.start("small", disk_bytes=2_000_000)
    hosts.trust()
    monkeypatch.setenv("HOME", str(hosts.operator))

    async def session() -> None:
        connection = await connect(host_of(small))
        await connection.write("fits", bytes(1000))
        with pytest.raises(HostWriteError, match="cannot write large: no space is left"):
            await connection.write("large", bytes(8_000_000))
        assert (await connection.run(["ls"])).text == "fits"
        await connection.close()

    run(session())


def test_connection_notices_lost_link(robot: SimulatedHost) -> None:
    async def session() -> None:
        connection = await connect(host_of(robot))
        robot.cut_link()
        try:
            with pytest.raises(HostUnreachable, match="the connection was lost"):
                await connection.run(["sleep", "600"], timeout_s=600)
            with pytest.raises(HostUnreachable, match="the connection was lost"):
                await connection.read("x")
            with pytest.raises(HostUnreachable, match=r"no way to the address|no answer within"):
                await connect(host_of(robot))
        finally:
            robot.restore_link()
        again = await connect(host_of(robot))
        assert (await again.run(["true"])).code == 0
        await again.close()

    run(session())


def test_connection_closes_while_the_link_is_cut(robot: SimulatedHost) -> None:
    async def session() -> None:
        connection = await connect(host_of(robot))
        process = await connection.start(["sleep", "600"])
        robot.cut_link()
        try:
            await process.write(bytes(100_000))
            async with asyncio.timeout(30):  # no keepalive ends it any more
                await connection.close()
        finally:
            robot.restore_link()

    run(session())
