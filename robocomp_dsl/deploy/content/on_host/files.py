"""Stores blobs and builds trees on a host.

In: requests with the folder of a deployment. Out: what the folder lacks, and new files in it. A
file or folder gets its name when it is complete; whatever ends a run, the next one continues.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import hashlib
import json
import os
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any

COPIED_BYTES = 1 << 20
"""Files of a tree up to this size are copies that a component may change; others are links."""
FEW_FILES = 64
BLOB_TIME_S = 1
"""The modification time of every blob; another time tells that somebody wrote to it."""


def find_lacking(request: dict[str, Any]) -> dict[str, Any]:
    """The trees and blobs that the folder lacks, and how much space is free.

    `trees` are hashes; `blobs` are pairs of name and size.
    """
    root = Path(request["root"])
    root.mkdir(parents=True, exist_ok=True)
    space = shutil.disk_usage(root)
    blobs = root / "blobs"
    lacking = [name for name, size in request["blobs"] if not _has_blob(blobs / name, size)]
    return {
        "free_bytes": space.free,
        "home": str(Path.home()),
        "trees": [name for name in request["trees"] if not _has_tree(root / "trees", name)],
        "blobs": lacking,
        "chunks": {name: found for name in lacking if (found := _chunks_of(root, name))},
    }


def store_blobs(request: dict[str, Any]) -> dict[str, Any]:
    """Store small blobs; the payload has their contents in the order of `blobs`."""
    folder = Path(request["root"]) / "blobs"
    folder.mkdir(parents=True, exist_ok=True)
    start = 0
    damaged = []
    for name, size in request["blobs"]:
        content = request["payload"][start : start + size]
        start += size
        if hashlib.sha256(content).hexdigest() != name[:64]:
            damaged.append(name)
            continue
        draft = folder / f".new-{name}-{os.getpid()}"
        draft.write_bytes(content)
        _publish_blob(draft, folder / name)
    return {"damaged": damaged}


def store_chunk(request: dict[str, Any]) -> dict[str, Any]:
    """Store one chunk of a large blob: `name`, `index`."""
    folder = _incoming(Path(request["root"]), request["name"])
    folder.mkdir(parents=True, exist_ok=True)
    draft = folder / f".new-{request['index']}-{os.getpid()}"
    draft.write_bytes(request["payload"])
    draft.replace(folder / f"{request['index']}-{len(request['payload'])}")
    return {}


def join_chunks(request: dict[str, Any]) -> dict[str, Any]:
    """Make a blob of its chunks: `name`, and the `sizes` of all chunks."""
    root, name = Path(request["root"]), request["name"]
    incoming = _incoming(root, name)
    draft = root / "blobs" / f".new-{name}-{os.getpid()}"
    draft.parent.mkdir(parents=True, exist_ok=True)
    digest = hashlib.sha256()
    with draft.open("wb") as stream:
        for index, size in enumerate(request["sizes"]):
            with (incoming / f"{index}-{size}").open("rb") as chunk:
                while data := chunk.read(COPIED_BYTES):
                    digest.update(data)
                    stream.write(data)
        stream.flush()
        os.fsync(stream.fileno())
    intact = digest.hexdigest() == name[:64]
    if intact:
        _publish_blob(draft, root / "blobs" / name)
    else:
        draft.unlink()
    shutil.rmtree(incoming)
    return {"damaged": [] if intact else [name]}


def build_trees(request: dict[str, Any]) -> dict[str, Any]:
    """Build `trees` of stored blobs: by hash its `files` (path, blob, size) and `folders`."""
    root = Path(request["root"])
    folder = root / "trees"
    folder.mkdir(parents=True, exist_ok=True)
    drafts = []
    written: list[Path] = []
    for name, tree in request["trees"].items():
        draft = folder / f".new-{name}-{os.getpid()}"
        shutil.rmtree(draft, ignore_errors=True)
        complete = folder / name
        written += _fill(draft if not complete.is_dir() else complete, root / "blobs", tree)
        manifest = folder / f".new-{name}-{os.getpid()}.json"
        manifest.write_text(json.dumps(tree))
        manifest.replace(folder / f"{name}.json")
        if not complete.is_dir():
            drafts.append((draft, complete))
    _store(root, written)  # after a power failure no complete tree has empty files
    for draft, complete in drafts:
        _rename_folder(draft, complete)
    return {}


def _fill(folder: Path, blobs: Path, tree: dict[str, Any]) -> list[Path]:
    """Add the files that a tree lacks; a file that exists may have been changed on purpose.

    The copies that are not stored on the disk yet.
    """
    for name in (".", *tree["folders"]):
        (folder / name).mkdir(parents=True, exist_ok=True)
    known = set()
    written = []
    for path, blob, size in tree["files"]:
        file = folder / path
        if file.parent not in known:
            file.parent.mkdir(parents=True, exist_ok=True)
            known.add(file.parent)
        if not os.path.lexists(file) and not (size > COPIED_BYTES and _link(blobs / blob, file)):
            _copy(blobs / blob, file)
            written.append(file)
    return written


def _link(blob: Path, file: Path) -> bool:
    """Whether a link could be made."""
    try:
        os.link(blob, file)
    except OSError as error:
        if error.errno in (errno.EMLINK, errno.EPERM, errno.EXDEV):
            return False
        raise
    return True


def _copy(blob: Path, file: Path) -> None:
    draft = file.with_name(f".new-{file.name[:200]}")
    shutil.copyfile(blob, draft)
    draft.chmod(0o755 if blob.name.endswith("-x") else 0o644)
    draft.replace(file)


def _store(root: Path, files: list[Path]) -> None:
    """Wait until the disk has `files`; of many, until it has all of the file system."""
    if len(files) > FEW_FILES:
        descriptor = os.open(root, os.O_RDONLY)
        failed = ctypes.CDLL(None).syncfs(descriptor)
        os.close(descriptor)
        if failed:
            os.sync()
        return
    for file in files:
        with file.open("rb") as stream:
            os.fsync(stream.fileno())


def _rename_folder(draft: Path, complete: Path) -> None:
    try:
        draft.rename(complete)
    except OSError as error:
        if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
            raise
        shutil.rmtree(draft)  # another rcdeploy built the same tree meanwhile


def _has_tree(trees: Path, name: str) -> bool:
    """Whether a tree is there with all its files."""
    try:
        tree = json.loads((trees / f"{name}.json").read_bytes())
        paths: Sequence[str] = [*tree["folders"], *(path for path, _, _ in tree["files"])]
    except (OSError, ValueError, KeyError, TypeError):
        return False
    folder = trees / name
    return folder.is_dir() and all(os.path.lexists(folder / path) for path in paths)


def _has_blob(blob: Path, size: int) -> bool:
    """Whether a blob is there and nobody wrote to it; a changed one is deleted."""
    try:
        status = blob.lstat()
    except OSError:
        return False
    if status.st_size == size and int(status.st_mtime) == BLOB_TIME_S:
        return True
    blob.unlink()
    return False


def _publish_blob(draft: Path, blob: Path) -> None:
    draft.chmod(0o555 if blob.name.endswith("-x") else 0o444)
    os.utime(draft, (BLOB_TIME_S, BLOB_TIME_S))
    draft.replace(blob)


def _incoming(root: Path, name: str) -> Path:
    return root / "incoming" / name


def _chunks_of(root: Path, name: str) -> list[str]:
    """The complete chunks of a blob, each as `INDEX-SIZE`."""
    with contextlib.suppress(OSError):
        return [file.name for file in _incoming(root, name).iterdir() if file.name[0] != "."]
    return []
