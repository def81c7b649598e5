"""Logins on real OpenSSH servers: keys, host keys, settings, failures."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import pytest

from robocomp_dsl.deploy.hosts.connection import HostConnection, connect
from robocomp_dsl.deploy.hosts.errors import HostError, HostRefused
from robocomp_dsl.model.deployment import Host
from tests.hosts.connections import failure, host_of, run
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost
from tests.support.waiting import wait_until


@pytest.fixture(scope="module")
def robot(module_hosts: Hosts) -> SimulatedHost:
    return module_hosts.start("robot")


@pytest.fixture(autouse=True)
def known_robot(module_hosts: Hosts, robot: SimulatedHost, operator: Path) -> None:
    """The person who connects knows the keys of the hosts."""
    module_hosts.trust()


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


def test_connection_reports_old_servers(robot: SimulatedHost) -> None:
    robot.write_sshd_config(["KexAlgorithms diffie-hellman-group1-sha1"])
    errors: list[HostError] = []

    def names_reason() -> bool:
        """The server may close the connection before its offer is read."""
        errors.append(failure(host_of(robot)))
        # Keys of the host are confirmed; their kinds are not the reason.
        return "there is no SSH algorithm in common" in str(errors[-1])

    try:
        wait_until(names_reason, lambda: str(errors[-1]))
    finally:
        robot.write_sshd_config()
    assert errors[-1].code.id == "RC831"


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
        known = operator / ".ssh/known_hosts"
        lines = known.read_text("utf-8").splitlines(keepends=True)
        known.write_text("".join(line for line in lines if jump.address not in line), "utf-8")
        error = failure(Host("robot", "robot", "robot"))
        assert "the jump host of ~/.ssh/config cannot be used: Host key" in str(error)
        assert error.help == "try `ssh robot@robot`"
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
