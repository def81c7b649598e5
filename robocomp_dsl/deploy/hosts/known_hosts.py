"""Host keys that the user has confirmed, in files in the format of OpenSSH.

Keys are read from robocomp's own file, the user's, and the machine's; only robocomp's own file is
written. In: the name of a host. Out: its keys, with the line where each is.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from asyncssh import SSHKey

DEFAULT_PORT = 22
SYSTEM_FILE = Path("/etc/ssh/ssh_known_hosts")
REVOKED = "revoked"
AUTHORITY = "cert-authority"


@dataclass(frozen=True, slots=True)
class KnownKey:
    """A line of a file. `kind`: "" for a host key, `revoked` or `cert-authority`."""

    path: Path
    line: int
    key: SSHKey
    kind: str = ""

    @property
    def place(self) -> str:
        """`~/.ssh/known_hosts:3`."""
        home = Path.home()
        below = self.path.is_relative_to(home)
        path = f"~/{self.path.relative_to(home)}" if below else str(self.path)
        return f"{path}:{self.line}"


def own_file() -> Path:
    """Robocomp's own file, which `rcdeploy hosts trust` writes."""
    base = os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config"
    return Path(base, "robocomp", "known_hosts")


def files() -> tuple[Path, ...]:
    """All files that are read."""
    return (own_file(), Path.home() / ".ssh/known_hosts", SYSTEM_FILE)


def host_id(name: str, port: int = 0) -> str:
    """The name of a host in the files: `robot.local`, or `[robot.local]:2222`."""
    return f"[{name}]:{port}" if port and port != DEFAULT_PORT else name


def find_keys(name: str, address: str = "", port: int = 0) -> list[KnownKey]:
    """The keys of a host by its name, or by its IP `address`; lines with errors are skipped."""
    return [key for path in files() for key in _keys_in(path, name, address, port)]


def _keys_in(path: Path, name: str, address: str, port: int) -> Iterator[KnownKey]:
    from asyncssh import import_known_hosts  # noqa: PLC0415 - only with hosts

    try:
        text = path.read_text("utf-8", "replace")
    except OSError:
        return
    other_port = port if port != DEFAULT_PORT else 0
    for number, line in enumerate(text.splitlines(), 1):
        try:
            matches = import_known_hosts(line).match(name, address, other_port or None)
        except ValueError:
            continue
        for kind, keys in zip(("", AUTHORITY, REVOKED), matches[:3], strict=True):
            yield from (KnownKey(path, number, key, kind) for key in keys)


def asyncssh_keys(known: list[KnownKey]) -> tuple[list[Any], ...]:
    """`known` in the form in which asyncssh takes it: trusted, authorities, revoked, X.509."""
    kinds = ("", AUTHORITY, REVOKED)
    keys = ([key.key for key in known if key.kind == kind] for kind in kinds)
    return (*keys, [], [], [], [])


def fingerprint(key: SSHKey) -> str:
    """`SHA256:…`, as `ssh-keygen -l` prints it."""
    return key.get_fingerprint("sha256")


def key_type(key: SSHKey) -> str:
    """`ED25519`, as `ssh-keygen -l` prints it."""
    name = key.get_algorithm().removeprefix("ssh-").removeprefix("sk-").split("-")[0]
    return name.split("@")[0].upper()


def add_key(host: str, key: SSHKey) -> None:
    """Add the key of `host` (as from `host_id`) to robocomp's own file. Raises `OSError`.

    The line is appended at once: another rcdeploy may add one at the same time.
    """
    algorithm, data = key.export_public_key("openssh").decode("ascii").split()[:2]
    path = own_file()
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    descriptor = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC, 0o600)
    with os.fdopen(descriptor, "r+b", buffering=0) as file:
        begin = b"" if file.read()[-1:] in {b"", b"\n"} else b"\n"
        file.write(begin + f"{host} {algorithm} {data}\n".encode())


def remove_keys(keys: list[KnownKey]) -> None:
    """Remove those of `keys` that are in robocomp's own file. Raises `OSError`."""
    path = own_file()
    numbers = {key.line for key in keys if key.path == path}
    if not numbers:
        return
    lines = path.read_text("utf-8").splitlines()
    rest = [line for number, line in enumerate(lines, 1) if number not in numbers]
    with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as draft:
        draft.write("".join(f"{line}\n" for line in rest))
    Path(draft.name).replace(path)
