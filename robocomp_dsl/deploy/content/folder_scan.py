"""Lists the files of a folder that are copied to a host.

In: a folder. Out: its files with their status, and problems. Symbolic links are followed: a host
gets the file or folder that they lead to. Version control, caches, virtual environments, backups of
editors, sockets and devices are left out.
"""

from __future__ import annotations

import os
import stat
from dataclasses import dataclass, field
from pathlib import Path

MAX_FILE_BYTES = 1 << 30
MAX_FILES = 20_000

LEFT_OUT_FOLDERS = frozenset(
    {
        ".git", ".hg", ".svn", ".rcgen", ".venv", "__pycache__", "node_modules", ".cache",
        ".mypy_cache", ".pytest_cache", ".ruff_cache", ".hypothesis", ".tox", ".nox",
        ".ipynb_checkpoints", ".idea", ".vscode",
    }
)  # fmt: skip
_LEFT_OUT_NAMES = frozenset({".DS_Store", ".directory", "Thumbs.db"})
_LEFT_OUT_SUFFIXES = (".pyc", ".pyo", ".swp", ".swo", "~", ".orig", ".rej")
_LEFT_OUT_PREFIXES = (".#", ".nfs")


@dataclass(frozen=True, slots=True)
class ScanProblem:
    """A file or folder that cannot be copied; `message` is in the user's words."""

    path: Path
    message: str
    help: str = ""


@dataclass(frozen=True, slots=True)
class FolderScan:
    """The regular files below a folder with their status, sorted by path, and the problems."""

    files: tuple[tuple[str, os.stat_result], ...]
    problems: tuple[ScanProblem, ...]


@dataclass(slots=True)
class _Walk:
    files: list[tuple[str, os.stat_result]] = field(default_factory=list)
    problems: list[ScanProblem] = field(default_factory=list)


def scan_folder(folder: Path) -> FolderScan:
    """The files below `folder`, at most `MAX_FILES`."""
    walk = _Walk()
    try:
        status = folder.stat()
    except OSError as error:
        return FolderScan((), (ScanProblem(folder, error.strerror or str(error)),))
    _walk(str(folder), ((status.st_dev, status.st_ino),), walk)
    if len(walk.files) > MAX_FILES:
        message = f"has more than {MAX_FILES} files"
        help_text = "move what the component does not need out of its folder"
        walk.problems.append(ScanProblem(folder, message, help_text))
    return FolderScan(tuple(walk.files[:MAX_FILES]), tuple(walk.problems))


def check_file(path: str, status: os.stat_result) -> ScanProblem | None:
    """Why a regular file cannot be copied; None if it can."""
    if status.st_size > MAX_FILE_BYTES:
        size = f"{status.st_size / 1e9:.1f} GB"
        return ScanProblem(
            Path(path),
            f"is too large ({size}; at most {MAX_FILE_BYTES / 1e9:.1f} GB)",
            "move it out of the folder, or copy it to the host yourself",
        )
    return check_name(path)


def check_name(path: str) -> ScanProblem | None:
    """Why a path cannot be copied because of its name; None if it can."""
    try:
        path.encode()
    except UnicodeEncodeError:
        return ScanProblem(Path(path), "has a name that is not encoded in UTF-8", "rename it")
    return None


def _walk(folder: str, ancestors: tuple[tuple[int, int], ...], walk: _Walk) -> None:
    """Add the files of `folder`; `ancestors` are the inodes of the folders that lead to it."""
    if len(walk.files) > MAX_FILES:
        return
    try:
        with os.scandir(folder) as found:
            entries = sorted(found, key=lambda entry: entry.name)
    except OSError as error:
        walk.problems.append(_unreadable(Path(folder), error))
        return
    for entry in entries:
        if is_left_out(entry.name):
            continue
        try:
            status = entry.stat()
        except OSError as error:
            walk.problems.append(_broken_link(Path(entry.path), error))
            continue
        if stat.S_ISDIR(status.st_mode):
            _enter(entry.path, status, ancestors, walk)
        elif stat.S_ISREG(status.st_mode):
            if problem := check_file(entry.path, status):
                walk.problems.append(problem)
            else:
                walk.files.append((entry.path, status))


def _enter(
    folder: str, status: os.stat_result, ancestors: tuple[tuple[int, int], ...], walk: _Walk
) -> None:
    identity = (status.st_dev, status.st_ino)
    path = Path(folder)
    if identity in ancestors:
        help_text = "remove the link"
        walk.problems.append(ScanProblem(path, "is a symbolic link to its own folder", help_text))
    elif problem := check_name(folder):
        walk.problems.append(problem)
    elif not (path / "pyvenv.cfg").is_file():
        _walk(folder, (*ancestors, identity), walk)


def is_left_out(name: str) -> bool:
    """Whether a file or folder of this name is never copied with its folder."""
    return (
        name in LEFT_OUT_FOLDERS
        or name in _LEFT_OUT_NAMES
        or name.endswith(_LEFT_OUT_SUFFIXES)
        or name.startswith(_LEFT_OUT_PREFIXES)
    )


def _unreadable(path: Path, error: OSError) -> ScanProblem:
    return ScanProblem(
        path, f"cannot be read: {error.strerror or error}", f"chmod u+rX {path}, or move it away"
    )


def _broken_link(path: Path, error: OSError) -> ScanProblem:
    if not path.is_symlink():
        return _unreadable(path, error)
    target = _link_target(path)
    if isinstance(error, FileNotFoundError):
        message = f"is a symbolic link to {target}, which does not exist"
    else:
        message = f"is a symbolic link to {target}, which cannot be followed: {error.strerror}"
    return ScanProblem(path, message, "remove the link, or create its target")


def _link_target(path: Path) -> str:
    try:
        return str(path.readlink())
    except OSError:
        return "an unknown file"
