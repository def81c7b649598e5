"""`rcdeploy hosts trust`: keys of real OpenSSH servers are shown, confirmed and replaced."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest

from tests.hosts.rcdeploy_command import rcdeploy
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost
from tests.hosts.test_host_checks import app_of

PROGRAM = "from robocomp_dsl.cli.rcdeploy.main import main; main()"


@pytest.fixture(scope="module")
def robot(module_hosts: Hosts) -> SimulatedHost:
    return module_hosts.start("robot")


@pytest.fixture
def app(robot: SimulatedHost, operator: Path, tmp_path: Path) -> Path:
    (operator / ".ssh/known_hosts").unlink(missing_ok=True)
    return app_of(tmp_path, robot)


def fingerprint(robot: SimulatedHost) -> str:
    """As an administrator sees it on the host itself."""
    text = robot.run(["ssh-keygen", "-lf", "/run/host/etc/ssh_host_ed25519_key.pub"], root=True)
    return text.stdout.split()[1]


def own_file(operator: Path) -> Path:
    return operator / ".config/robocomp/known_hosts"


def test_trust_without_terminal_needs_the_fingerprint(
    robot: SimulatedHost, app: Path, operator: Path
) -> None:
    shown = rcdeploy("hosts", str(app))
    assert "unknown key" in shown.stdout
    assert f"confirm it: `rcdeploy hosts trust {app} robot`" in shown.stderr
    outcome = rcdeploy("hosts", "trust", str(app))
    assert outcome.code == 1
    assert f"ED25519 key {fingerprint(robot)}" in outcome.stdout
    assert f"`--fingerprint {fingerprint(robot)}`" in outcome.stderr
    assert "not confirmed: `robot`" in outcome.stderr
    other = rcdeploy("hosts", "trust", str(app), "--fingerprint", "SHA256:" + "A" * 43)
    assert other.code == 1
    assert "does not have the fingerprint" in other.stderr
    assert not own_file(operator).exists()
    outcome = rcdeploy(str(app), "hosts", "trust", "robot", "--fingerprint", fingerprint(robot))
    assert (outcome.code, outcome.stderr) == (0, "")
    assert own_file(operator).read_text("utf-8") == f"{robot.address} {robot.host_key()}\n"
    assert own_file(operator).stat().st_mode & 0o777 == 0o600
    assert "its key is confirmed already" in rcdeploy("hosts", "trust", str(app)).stdout
    assert rcdeploy("hosts", str(app)).code == 0


@pytest.mark.parametrize(("answer", "code"), [("y", 0), ("n", 1), ("", 1)])
def test_trust_asks_at_a_terminal(
    robot: SimulatedHost, app: Path, operator: Path, answer: str, code: int
) -> None:
    terminal, inner = pty.openpty()
    command = [sys.executable, "-c", PROGRAM, "hosts", "trust", str(app)]
    process = subprocess.Popen(
        command, stdin=inner, stdout=inner, stderr=inner, start_new_session=True
    )
    os.close(inner)
    text = b""
    while b"Trust this key? [y/N]" not in text:
        text += os.read(terminal, 1000)
    assert fingerprint(robot).encode() in text
    os.write(terminal, f"{answer}\n".encode())
    assert process.wait(60) == code
    os.close(terminal)
    assert own_file(operator).exists() is (code == 0)


def test_trust_replaces_a_changed_key_only_on_request(
    robot: SimulatedHost, app: Path, operator: Path
) -> None:
    rcdeploy("hosts", "trust", str(app), "--fingerprint", fingerprint(robot))
    old = fingerprint(robot)
    robot.replace_host_key()
    new = fingerprint(robot)
    for words in (("hosts", "trust"), ("hosts", "show")):
        assert rcdeploy(*words, str(app)).code == 1
    refused = rcdeploy("hosts", "trust", str(app), "--fingerprint", new)
    assert refused.code == 1
    assert "WARNING: ANOTHER KEY IS CONFIRMED FOR THIS HOST" in refused.stdout
    assert f"ED25519 key {old} in ~/.config/robocomp/known_hosts:1" in refused.stdout
    assert "`--replace` replaces it" in refused.stderr
    assert "RC833" in rcdeploy("hosts", str(app)).stderr
    replaced = rcdeploy("hosts", "trust", str(app), "--replace", "--fingerprint", new)
    assert (replaced.code, replaced.stderr) == (0, "")
    assert own_file(operator).read_text("utf-8") == f"{robot.address} {robot.host_key()}\n"
    assert rcdeploy("hosts", str(app)).code == 0


def test_trust_leaves_the_files_of_openssh_alone(
    robot: SimulatedHost, app: Path, operator: Path, module_hosts: Hosts
) -> None:
    module_hosts.trust()
    known = operator / ".ssh/known_hosts"
    before = known.read_text("utf-8")
    robot.replace_host_key()
    words = ("hosts", "trust", str(app), "--replace", "--fingerprint", fingerprint(robot))
    outcome = rcdeploy(*words)
    assert outcome.code == 1
    command = f"ssh-keygen -f {known} -R '{robot.address}'"
    assert f"remove it: `{command}`" in outcome.stderr
    assert known.read_text("utf-8") == before
    subprocess.run(command, shell=True, check=True, capture_output=True)
    assert rcdeploy(*words).code == 0


def test_trust_sees_keys_of_another_kind(
    robot: SimulatedHost, app: Path, operator: Path, tmp_path: Path
) -> None:
    """The host has no key of the kind that is confirmed: it is a changed key, too."""
    key = tmp_path / "rsa"
    subprocess.run(["ssh-keygen", "-qt", "ecdsa", "-N", "", "-f", str(key)], check=True)
    public = Path(f"{key}.pub").read_text("ascii").split()
    own_file(operator).parent.mkdir(parents=True)
    own_file(operator).write_text(f"{robot.address} {public[0]} {public[1]}\n", "utf-8")
    assert "RC833" in rcdeploy("hosts", str(app)).stderr
    words = ("hosts", "trust", str(app), "--fingerprint", fingerprint(robot))
    assert "ECDSA key" in rcdeploy(*words).stdout
    assert rcdeploy(*words, "--replace").code == 0
    assert rcdeploy("hosts", str(app)).code == 0


def test_trust_reports_unreachable_and_unknown_hosts(app: Path) -> None:
    assert "did you mean `robot`?" in rcdeploy("hosts", "trust", str(app), "robo").stderr
    text = app.read_text("utf-8")
    app.write_text(text.replace("10.77", "10.99"), "utf-8")
    outcome = rcdeploy("hosts", "trust", str(app))
    assert outcome.code == 1
    assert "no way to the address; check that the computer is on" in outcome.stderr
