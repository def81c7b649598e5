"""Private folders of the user, for sockets, locks and tokens.

In: a path. Out: a folder that nobody else can read, enter or replace. The folder of the user is
`robocomp-<uid>` in `XDG_RUNTIME_DIR`, or in the temporary folder.
"""

from __future__ import annotations

import contextlib
import hmac
import os
import re
import secrets
import stat
import tempfile
from pathlib import Path

USER = "robocomp"
"""The user name that belongs to the token."""
TOKEN_BYTES = 16
_TOKEN = re.compile(rf"{USER}:([0-9a-f]{{{2 * TOKEN_BYTES}}})\n")


class UnsafeFolder(Exception):
    """A folder that others can use, or that cannot be used at all; the message has the remedy."""


def user_folder() -> Path:
    """The folder of this user, created if missing. Raises `UnsafeFolder`."""
    base = Path(os.environ.get("XDG_RUNTIME_DIR") or tempfile.gettempdir())
    return private_folder(base / f"robocomp-{os.getuid()}")


def private_folder(path: Path) -> Path:
    """`path` as a folder of this user with mode 0700, created if missing.

    Raises `UnsafeFolder` for a symbolic link, another owner, or access by other users: another user
    may have created it first.
    """
    try:
        path.mkdir(mode=0o700, exist_ok=True)
        status = path.lstat()
    except OSError as error:
        reason = error.strerror or error
        raise UnsafeFolder(f"{path} cannot be used: {reason}; set XDG_RUNTIME_DIR") from None
    if not stat.S_ISDIR(status.st_mode):
        raise UnsafeFolder(f"{path} is a symbolic link; delete it, or set XDG_RUNTIME_DIR")
    if status.st_uid != os.getuid():
        raise UnsafeFolder(
            f"{path} belongs to another user (uid {status.st_uid}); set XDG_RUNTIME_DIR to a folder"
            " of your own"
        )
    mode = stat.S_IMODE(status.st_mode)
    if mode & 0o077:
        raise UnsafeFolder(
            f"{path} is open to other users (mode {mode:o}); check its content, then run"
            f" `chmod 700 {path}`"
        )
    return path


def token_file(folder: Path) -> Path:
    """The file with `robocomp:<token>` in the user's folder, created if missing.

    Peers and browser pages ask for the token: whoever can read it is this user. Raises
    `UnsafeFolder`.
    """
    path = folder / "token"
    if not path.exists():
        _create(path, f"{USER}:{secrets.token_hex(TOKEN_BYTES)}\n")
    _parse_token(path)
    return path


def read_token(folder: Path) -> str:
    """The token of `token_file`. Raises `UnsafeFolder`."""
    return _parse_token(token_file(folder))


def read_page_token() -> str:
    """The token in the URL of browser pages of this user: 32 hexadecimal digits.

    It is derived from that of `token_file`, which cannot be computed from it: browsers keep URLs.
    Raises `UnsafeFolder`.
    """
    token = read_token(user_folder())
    return hmac.new(token.encode(), b"browser page", "sha256").hexdigest()[: 2 * TOKEN_BYTES]


def _parse_token(path: Path) -> str:
    try:
        text = path.read_text(encoding="ascii")
    except (OSError, UnicodeDecodeError) as error:
        raise UnsafeFolder(f"{path} cannot be read: {error}") from None
    if not (match := _TOKEN.fullmatch(text)):
        raise UnsafeFolder(f"{path} holds no token; delete it when no component is running")
    return match[1]


def _create(path: Path, content: str) -> None:
    """Create a file with mode 0600; of several processes that do, one succeeds."""
    draft = path.with_name(f"{path.name}.{os.getpid()}-{secrets.token_hex(4)}")
    try:
        descriptor = os.open(draft, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
        with os.fdopen(descriptor, "w", encoding="ascii") as stream:
            stream.write(content)
        with contextlib.suppress(FileExistsError):
            os.link(draft, path)
        draft.unlink()
    except OSError as error:
        raise UnsafeFolder(f"{path} cannot be created: {error.strerror or error}") from None
