"""Deletes on a host what no version uses.

In: the number of versions to keep. Out: deleted files and folders. A file that a component wrote
into its tree is never deleted.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

FEWEST_VERSIONS = 3
_TREE = re.compile(r"trees/([0-9a-f]{64})")
_ENVIRONMENT = re.compile(r"environments/([0-9a-f]{64})")
_HASH = re.compile(r"[0-9a-f]{64}")


def collect_garbage(request: dict[str, Any]) -> dict[str, Any]:
    """Keep the newest `keep` versions and the current one with what they name; delete the rest."""
    root = Path(request["root"])
    before = shutil.disk_usage(root).free if root.is_dir() else 0
    texts = _versions(root, max(FEWEST_VERSIONS, request["keep"]))
    trees = {name for text in texts for name in _TREE.findall(text)}
    environments = {name for text in texts for name in _ENVIRONMENT.findall(text)}
    blobs = set(_blobs_of_trees(root / "trees", trees))
    blobs |= set(_blobs_of_environments(root / "environments", environments))
    outputs = _delete_trees(root / "trees", trees)
    removed = list(_delete_environments(root / "environments", environments))
    if removed:
        shutil.rmtree(root / "cache", ignore_errors=True)  # environments have links to it
    for blob in _entries(root / "blobs"):
        if blob.name not in blobs:
            blob.unlink(missing_ok=True)
    for wheel in _entries(root / "wheels"):
        if wheel.name not in blobs:
            _delete(wheel)
    shutil.rmtree(root / "incoming", ignore_errors=True)
    freed = (shutil.disk_usage(root).free if root.is_dir() else 0) - before
    return {"freed_bytes": freed, "outputs": outputs, "trees": sorted(trees)}


def _versions(root: Path, keep: int) -> list[str]:
    """The manifests of the newest versions and of the current one; older ones are deleted."""
    numbers = sorted(
        (int(file.stem) for file in _entries(root / "versions") if file.stem.isdigit()),
        reverse=True,
    )
    current = ""
    with contextlib.suppress(OSError):
        current = (root / "current").read_text().strip()
    texts = []
    for position, number in enumerate(numbers):
        file = root / "versions" / f"{number}.json"
        if position < keep or str(number) == current:
            texts.append(file.read_text())
        else:
            file.unlink()
    return texts


def _blobs_of_trees(folder: Path, trees: set[str]) -> Iterator[str]:
    for name in trees:
        with contextlib.suppress(OSError, ValueError):
            for _, blob, _ in json.loads((folder / f"{name}.json").read_bytes())["files"]:
                yield blob


def _blobs_of_environments(folder: Path, environments: set[str]) -> Iterator[str]:
    for name in environments:
        with contextlib.suppress(OSError, ValueError):
            yield from json.loads((folder / name / "robocomp.json").read_bytes())["blobs"]


def _delete_trees(folder: Path, used: set[str]) -> list[str]:
    """Delete unused trees but for what components wrote; the paths of these files."""
    outputs: list[str] = []
    for entry in _entries(folder):
        name = entry.name.removesuffix(".json")
        if entry.name.startswith(".new-"):
            _delete(entry)
        elif entry.is_dir() and _HASH.fullmatch(name) and name not in used:
            outputs += _delete_tree(entry, folder / f"{name}.json")
    return outputs


def _delete_tree(tree: Path, manifest: Path) -> list[str]:
    paths: set[str] = set()
    if not manifest.exists() and not any(tree.iterdir()):
        tree.rmdir()
        return []
    with contextlib.suppress(OSError, ValueError):
        paths = {path for path, _, _ in json.loads(manifest.read_bytes())["files"]}
    outputs = []
    for folder, folders, files in os.walk(tree, topdown=False):
        for file in (Path(folder, name) for name in files):
            is_bytecode = file.parent.name == "__pycache__"
            if is_bytecode or file.relative_to(tree).as_posix() in paths:
                file.unlink()
            else:
                outputs.append(str(file))
        for name in folders:
            with contextlib.suppress(OSError):
                Path(folder, name).rmdir()
    with contextlib.suppress(OSError):
        tree.rmdir()
    manifest.unlink(missing_ok=True)
    return sorted(outputs)


def _delete_environments(folder: Path, used: set[str]) -> Iterator[str]:
    for entry in _entries(folder):
        if entry.name not in used:
            _delete(entry)
            yield entry.name


def _delete(entry: Path) -> None:
    if entry.is_dir() and not entry.is_symlink():
        shutil.rmtree(entry, ignore_errors=True)
    else:
        entry.unlink(missing_ok=True)


def _entries(folder: Path) -> list[Path]:
    try:
        return list(folder.iterdir())
    except OSError:
        return []
