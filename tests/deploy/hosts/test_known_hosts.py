"""Files of confirmed host keys, in the format of OpenSSH."""

from __future__ import annotations

import base64
import hmac
from pathlib import Path

import asyncssh
import pytest

from robocomp_dsl.deploy.hosts import known_hosts

KEYS = [asyncssh.generate_private_key("ssh-ed25519").convert_to_public() for _ in range(3)]
LINES = [" ".join(key.export_public_key("openssh").decode().split()[:2]) for key in KEYS]


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("XDG_CONFIG_HOME", raising=False)
    monkeypatch.setattr(known_hosts, "SYSTEM_FILE", tmp_path / "ssh_known_hosts")
    (tmp_path / ".ssh").mkdir()
    return tmp_path


def found(name: str, address: str = "", port: int = 0) -> list[tuple[str, str]]:
    """Place and kind of the keys of a host."""
    return [(key.place, key.kind) for key in known_hosts.find_keys(name, address, port)]


def test_known_hosts_finds_keys_in_all_files(home: Path) -> None:
    known_hosts.add_key("robot", KEYS[0])
    user = f"# keys\n\nwrong line\nrobot,10.0.0.2 {LINES[1]}\n@revoked * {LINES[2]}\n"
    (home / ".ssh/known_hosts").write_text(user, "utf-8")
    (home / "ssh_known_hosts").write_text(f"@cert-authority *.lab {LINES[2]}\n", "utf-8")
    own = "~/.config/robocomp/known_hosts:1"
    assert found("robot") == [
        (own, ""),
        ("~/.ssh/known_hosts:4", ""),
        ("~/.ssh/known_hosts:5", "revoked"),
    ]
    assert found("other", "10.0.0.2")[0] == ("~/.ssh/known_hosts:4", "")
    assert ("~/ssh_known_hosts:1", "cert-authority") in found("arm.lab")
    trusted, authorities, revoked, *certificates = known_hosts.asyncssh_keys(
        known_hosts.find_keys("robot")
    )
    assert (trusted, authorities, revoked) == ([KEYS[0], KEYS[1]], [], [KEYS[2]])
    assert not any(certificates)


def test_known_hosts_finds_keys_by_port_and_hash(home: Path) -> None:
    known_hosts.add_key(known_hosts.host_id("robot", 2222), KEYS[0])
    assert known_hosts.own_file().read_text("utf-8").startswith("[robot]:2222 ssh-ed25519 ")
    assert found("robot", port=2222)
    assert not found("robot")
    (home / ".ssh/known_hosts").write_text(f"{hash_of('robot')} {LINES[1]}\n", "utf-8")
    assert found("robot") == [("~/.ssh/known_hosts:1", "")]


def hash_of(name: str) -> str:
    """A name as `ssh-keygen -H` writes it."""
    salt = bytes(20)
    digest = hmac.new(salt, name.encode(), "sha1").digest()
    return f"|1|{base64.b64encode(salt).decode()}|{base64.b64encode(digest).decode()}"


def test_known_hosts_replaces_only_own_keys(home: Path) -> None:
    for key in KEYS:
        known_hosts.add_key("robot", key)
    known_hosts.add_key("base", KEYS[0])
    user = home / ".ssh/known_hosts"
    user.write_text(f"robot {LINES[0]}\n", "utf-8")
    known_hosts.remove_keys(known_hosts.find_keys("robot"))
    assert known_hosts.own_file().read_text("utf-8") == f"base {LINES[0]}\n"
    assert user.read_text("utf-8") == f"robot {LINES[0]}\n"
    assert known_hosts.own_file().stat().st_mode & 0o777 == 0o600
    assert known_hosts.own_file().parent.stat().st_mode & 0o777 == 0o700


def test_known_hosts_appends_to_edited_file(home: Path) -> None:
    known_hosts.own_file().parent.mkdir(parents=True)
    known_hosts.own_file().write_text(f"base {LINES[0]}", "utf-8")  # no line end
    known_hosts.add_key("robot", KEYS[1])
    expected = f"base {LINES[0]}\nrobot {LINES[1]}\n"
    assert known_hosts.own_file().read_text("utf-8") == expected


def test_known_hosts_describes_keys_as_ssh_keygen(tmp_path: Path) -> None:
    assert known_hosts.fingerprint(KEYS[0]).startswith("SHA256:")
    assert known_hosts.key_type(KEYS[0]) == "ED25519"
    rsa = asyncssh.generate_private_key("ssh-rsa", key_size=2048)
    ecdsa = asyncssh.generate_private_key("ecdsa-sha2-nistp256")
    assert [known_hosts.key_type(key) for key in (rsa, ecdsa)] == ["RSA", "ECDSA"]
