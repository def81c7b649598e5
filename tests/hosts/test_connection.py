"""Connections to real OpenSSH servers."""

from __future__ import annotations

import asyncio
import os
import subprocess
import tempfile
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.hosts.connection import HostConnection, Upload, connect
from robocomp_dsl.deploy.hosts.errors import (
    HostError,
    HostRefused,
    HostTimeout,
    HostUnreachable,
    HostWriteError,
)
from robocomp_dsl.model.deployment import Host
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost
from tests.support.waiting import wait_until

TEST_TIMEOUT_S = 120.0
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


def run(task: Coroutine[Any, Any, Any]) -> Any:
    """The result of `task`, which must not hang."""
    return asyncio.run(asyncio.wait_for(task, TEST_TIMEOUT_S))


def host_of(machine: SimulatedHost, address: str = "", user: str = "", port: int = 0) -> Host:
    name = machine.name
    return Host(name, address or machine.address, user or machine.user, ssh_port=port)


def failure(host: Host) -> HostError:
    """Why a connection is refused."""

    async def attempt() -> HostError:
        with pytest.raises(HostError) as caught:
            await connect(host)
        return caught.value

    return run(attempt())


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
            await connection.run(["sleep", "60"], timeout_s=0.2)
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


@pytest.mark.parametrize(
    ("address", "user", "port", "message"),
    [
        ("", "robot", 2222, "nothing listens at port 2222"),
        ("10.99.0.2", "robot", 0, "no way to the address"),
        ("nobody.invalid", "robot", 0, "the name `nobody.invalid` has no address"),
        ("", "root", 0, "login was refused: no key of ~/.ssh or of the SSH agent is accepted"),
        ("", "stranger", 0, "the login was refused"),
    ],
)
def test_connection_failure_says_why(
    robot: SimulatedHost, address: str, user: str, port: int, message: str
) -> None:
    error = failure(host_of(robot, address, user, port))
    assert message in str(error)
    assert str(error).startswith("`robot` (")
    assert error.help


def test_connection_without_key_is_refused(robot: SimulatedHost, operator: Path) -> None:
    key = operator / ".ssh/id_ed25519"
    key.rename(key.with_name("elsewhere"))
    try:
        error = failure(host_of(robot))
    finally:
        key.with_name("elsewhere").rename(key)
    assert error.code.id == "RC831"
    assert f"`ssh-copy-id robot@{robot.address}`" in error.help


def test_connection_without_sftp_says_how_to_enable_it(robot: SimulatedHost) -> None:
    robot.write_sshd_config(["Subsystem other /bin/false"], sftp=False)

    async def session() -> None:
        connection = await connect(host_of(robot))
        with pytest.raises(HostRefused, match="its SSH server offers no SFTP") as caught:
            await connection.read("x")
        assert "Subsystem sftp internal-sftp" in caught.value.help
        await connection.close()

    try:
        run(session())
    finally:
        robot.write_sshd_config()


def test_connection_follows_ssh_config(robot: SimulatedHost, operator: Path) -> None:
    """An alias with address, port, user and key; settings that weaken host keys do not count."""
    robot.write_sshd_config(["Port 2200"])
    key = operator / ".ssh/id_ed25519"
    other = key.with_name("robots")
    key.rename(other)
    config = operator / ".ssh/config"
    config.write_text(
        f"Host arm\n  HostName {robot.address}\n  Port 2200\n  User robot\n"
        f"  IdentityFile {other}\n  UserKnownHostsFile none\n  StrictHostKeyChecking no\n",
        "utf-8",
    )
    known = operator / ".ssh/known_hosts"

    async def session() -> None:
        connection: HostConnection = await connect(Host("arm", "arm"))
        assert (await connection.run(["id", "-un"])).text == "robot"
        await connection.close()

    try:
        known.write_text(f"[{robot.address}]:2200 {robot.host_key()}\n", "utf-8")
        run(session())
        known.unlink()
        assert failure(Host("arm", "arm")).code.id == "RC832"
    finally:
        config.unlink()
        other.rename(key)
        robot.write_sshd_config()


def test_connection_refuses_unknown_and_changed_host_keys(
    robot: SimulatedHost, operator: Path
) -> None:
    known = operator / ".ssh/known_hosts"
    known.unlink()
    unknown = failure(host_of(robot))
    assert unknown.code.id == "RC832"
    assert "SHA256:" in str(unknown)
    assert "rcdeploy hosts trust APP.ddsl robot" in unknown.help
    known.write_text(f"{robot.address} {robot.host_key()}\n", "utf-8")
    robot.replace_host_key()
    changed = failure(host_of(robot))
    assert changed.code.id == "RC833"
    assert "(confirmed: ~/.ssh/known_hosts:1)" in str(changed)
    assert "--replace" in changed.help
    known.write_text(
        f"@revoked * {robot.host_key()}\n{robot.address} {robot.host_key()}\n", "utf-8"
    )
    assert "its host key is revoked in ~/.ssh/known_hosts:1" in str(failure(host_of(robot)))


def test_connection_goes_through_a_jump_host(
    module_hosts: Hosts, robot: SimulatedHost, operator: Path
) -> None:
    jump = module_hosts.start("jump")
    module_hosts.trust()
    config = operator / ".ssh/config"
    config.write_text(f"Host robot\n  HostName {robot.address}\n  ProxyJump jump@{jump.address}\n")

    async def session() -> str:
        connection = await connect(Host("robot", "robot", "robot"))
        text = (await connection.run(["sh", "-c", "echo $SSH_CONNECTION"])).text
        await connection.close()
        return text

    try:
        assert run(session()).split()[0] == jump.address
    finally:
        config.unlink()


def test_connection_uses_the_ssh_agent(
    robot: SimulatedHost, operator: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    key = operator / ".ssh/id_ed25519"
    elsewhere = key.rename(tmp_path / "key")
    with tempfile.TemporaryDirectory() as folder:  # paths of sockets must be short
        socket = Path(folder, "agent")
        with subprocess.Popen(["ssh-agent", "-D", "-a", str(socket)], stdout=-1) as agent:
            try:
                wait_until(socket.exists, "no agent")
                monkeypatch.setenv("SSH_AUTH_SOCK", str(socket))
                subprocess.run(["ssh-add", "-q", str(elsewhere)], check=True)

                async def session() -> int:
                    connection = await connect(host_of(robot))
                    code = (await connection.run(["true"])).code
                    await connection.close()
                    return code

                assert run(session()) == 0
            finally:
                agent.kill()
                elsewhere.rename(key)
