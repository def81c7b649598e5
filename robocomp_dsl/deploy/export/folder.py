"""Writes an exported deployment into its folder, and never over the files of others.

In: files by path. Out: the folder has exactly these files of rcdeploy; a manifest lists them with
their checksums, so that the next export can replace and delete them.
"""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path

from robocomp_dsl.deploy.content.tree import ContentTree

MANIFEST = ".rcdeploy-export.json"
_FORMAT = 1


class ForeignFiles(Exception):
    """Files in the folder are not from an earlier export; the message names them."""


class ExportFile:
    """The content of one file, as text or from a file here."""

    def __init__(self, text: str = "", source: Path | None = None, *, executable: bool = False):
        self._text = text
        self._source = source
        self.executable = executable

    def read(self) -> bytes:
        """The content. Raises `OSError`."""
        return self._source.read_bytes() if self._source else self._text.encode()


def tree_files(trees: Iterable[ContentTree], folder: str, digits: int) -> dict[str, ExportFile]:
    """The files of components below `folder`, each tree in a folder named after its hash."""
    return {
        f"{folder}/{tree.hash[:digits]}/{file.path}": ExportFile(
            source=Path(file.source), executable=file.executable
        )
        for tree in trees
        for file in tree.files
    }


def write_folder(folder: Path, target: str, files: Mapping[str, ExportFile]) -> int:
    """Write `files`; returns how many changed. Raises `ForeignFiles` and `OSError`.

    Nothing is written if a file of somebody else is in the way.
    """
    known = _read_manifest(folder)
    contents = {name: file.read() for name, file in sorted(files.items())}
    _refuse_foreign(folder, known, contents)
    changed = 0
    for name, data in contents.items():
        path = folder / name
        mode = 0o755 if files[name].executable else 0o644
        if not path.is_file() or path.read_bytes() != data or path.stat().st_mode & 0o777 != mode:
            changed += 1
            path.parent.mkdir(parents=True, exist_ok=True)
            draft = path.with_name(f".{path.name}.new")
            draft.write_bytes(data)
            draft.chmod(mode)
            draft.replace(path)
    for name in known.keys() - contents.keys():
        changed += 1
        _delete(folder, name)
    listed = {name: sha256(data).hexdigest() for name, data in contents.items()}
    manifest = {"format": _FORMAT, "target": target, "files": listed}
    (folder / MANIFEST).write_text(json.dumps(manifest, indent=1) + "\n", encoding="utf-8")
    return changed


def _refuse_foreign(folder: Path, known: Mapping[str, str], contents: Mapping[str, bytes]) -> None:
    """Raise if a file that would be replaced or deleted is not what an export has written."""
    foreign = []
    for name in sorted({*known, *contents}):
        path = folder / name
        if path.is_symlink() or (path.exists() and not path.is_file()):
            foreign.append(name)
        elif path.is_file():
            data = path.read_bytes()
            is_own = sha256(data).hexdigest() == known.get(name)
            if not is_own and data != contents.get(name):
                foreign.append(name)
        elif any(part.is_symlink() for part in path.parents if part.is_relative_to(folder)):
            foreign.append(name)
    if foreign:
        raise ForeignFiles(", ".join(foreign))


def _read_manifest(folder: Path) -> dict[str, str]:
    """The files of the last export with their checksums."""
    try:
        data = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        files = data["files"]
        return {str(name): str(files[name]) for name in files if _is_inside(str(name))}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def _is_inside(name: str) -> bool:
    return not name.startswith("/") and ".." not in Path(name).parts


def _delete(folder: Path, name: str) -> None:
    path = folder / name
    with contextlib.suppress(OSError):
        path.unlink()
    for parent in path.parents:
        if parent == folder or not parent.is_relative_to(folder):
            break
        with contextlib.suppress(OSError):
            parent.rmdir()
