"""The folder with the keys of one deployment: who can read it, and the names of its files.

In: the name of a deployment. Out: paths, and files written with mode 0600.

    ca.pem, ca.key              the certificate authority; its key never leaves this machine
    NAME.pem, NAME.key          of each identity; NAME is escaped
"""

from __future__ import annotations

import os
import stat
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import quote

AUTHORITY = "ca"


class UnsafeKeys(Exception):
    """The folder or a file can be used by others, or not at all; the message has the remedy."""


class KeyFolder:
    """The folder at `path`; it need not exist."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def certificate(self, name: str) -> Path:
        """The file with the certificate of an identity, or of `AUTHORITY`."""
        return self.path / f"{file_name(name)}.pem"

    def key(self, name: str) -> Path:
        """The file with the private key of an identity, or of `AUTHORITY`."""
        return self.path / f"{file_name(name)}.key"

    def has(self, name: str) -> bool:
        """Whether both files of an identity exist."""
        return self.certificate(name).exists() and self.key(name).exists()

    def create(self) -> None:
        """Create the folder, open to nobody else. Raises `UnsafeKeys`."""
        try:
            self.path.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            raise UnsafeKeys(f"{self.path} cannot be created: {error.strerror or error}") from None
        self.check()

    def check(self) -> None:
        """Raise `UnsafeKeys` if others can use the folder, or a key in it."""
        try:
            self._check(self.path, stat.S_ISDIR, 0o700)
            for path in sorted(self.path.glob("*.key")):
                self._check(path, stat.S_ISREG, 0o600)
        except OSError as error:
            raise UnsafeKeys(f"{self.path} cannot be read: {error.strerror or error}") from None

    def _check(self, path: Path, is_kind: object, mode: int) -> None:
        status = path.lstat()
        if not callable(is_kind) or not is_kind(status.st_mode):
            raise UnsafeKeys(f"{path} is a symbolic link or another kind of file; delete it")
        if status.st_uid != os.getuid():
            raise UnsafeKeys(f"{path} belongs to another user (uid {status.st_uid})")
        found = stat.S_IMODE(status.st_mode)
        if found & 0o077:
            raise UnsafeKeys(
                f"other users can use {path} (mode {found:o}): run `chmod {mode:o} {path}`"
            )

    def write(self, name: str, certificate: bytes, key: bytes) -> None:
        """Write both files of an identity; another process sees the old file or the new."""
        write_private(self.key(name), key)
        write_private(self.certificate(name), certificate)


def key_folder(deployment: str, environment: Mapping[str, str] | None = None) -> KeyFolder:
    """The folder of the deployment with this name: `~/.config/robocomp/keys/NAME`."""
    variables = os.environ if environment is None else environment
    configured = variables.get("XDG_CONFIG_HOME", "")
    base = Path(configured) if configured.startswith("/") else Path.home() / ".config"
    return KeyFolder(base / "robocomp" / "keys" / file_name(deployment))


def file_name(name: str) -> str:
    """`name` as the name of a file: `left/arm` is `left%2Farm`."""
    return quote(name, safe="") or "_"


def write_private(path: Path, data: bytes) -> None:
    """Replace a file in one step; only this user can read it. Raises `UnsafeKeys`."""
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.unlink(missing_ok=True)
        descriptor = os.open(draft, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        draft.replace(path)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise UnsafeKeys(f"{path} cannot be written: {error.strerror or error}") from None
