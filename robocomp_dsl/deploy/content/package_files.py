"""The files of `robocomp_dsl` that a running component needs, and the wheel made of them.

In: the package that runs here. Out: file names and content hash; a wheel with these files. The
toolchain stays behind, unless a component imports it.
"""

from __future__ import annotations

import base64
import hashlib
import os
import secrets
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import robocomp_dsl
from robocomp_dsl.deploy.content.hash_cache import HashCache

NAME = "robocomp_dsl"
RUNTIME_PACKAGES = (
    "hardware", "host_tools", "monitors", "runtime", "simulation", "tactile",
)  # fmt: skip
RUNTIME_MODULES = (
    "__init__.py", "client.py", "extras.py", "finding.py", "name_table.py", "py.typed",
    "qos_items.py", "record.py", "regular_file.py", "slice_identifiers.py",
)  # fmt: skip
_LEVEL = 4  # of libraries it takes half the time of the usual 6, and 4 % more bytes
_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_LEFT_OUT = frozenset({"__pycache__", "share"})
_SHARE = ("grammars", "templates", "interfaces")


@dataclass(frozen=True, slots=True)
class PackageFile:
    """A file of the package: its name in the wheel, and where it is here."""

    name: str
    source: Path


def is_runtime(module: str) -> bool:
    """Whether a module of `robocomp_dsl` is among the files of a running component."""
    parts = module.split(".")
    if parts[0] != NAME:
        return False
    return len(parts) == 1 or parts[1] in RUNTIME_PACKAGES or f"{parts[1]}.py" in RUNTIME_MODULES


@cache
def package_files(*, complete: bool) -> tuple[PackageFile, ...]:
    """The files for a host, sorted by name; `complete`: with the toolchain."""
    root = Path(robocomp_dsl.__file__).parent
    if complete:
        found = list(_files_below(root, NAME))
        found += [file for name in _SHARE for file in _shared(root, name)]
    else:
        found = [
            f for name in RUNTIME_PACKAGES for f in _files_below(root / name, f"{NAME}/{name}")
        ]
        found += [PackageFile(f"{NAME}/{name}", root / name) for name in RUNTIME_MODULES]
    return tuple(sorted(found, key=lambda file: file.name))


def package_version(*, complete: bool, hashes: HashCache) -> str:
    """The version on hosts: the version here and the first digits of the content's hash."""
    digest = hashlib.sha256()
    for file in package_files(complete=complete):
        content = hashes.sha256(str(file.source), file.source.stat())
        digest.update(f"{file.name}\0{content}\0".encode())
    return f"{robocomp_dsl.__version__}+host.{digest.hexdigest()[:16]}"


def write_package_wheel(
    folder: Path, version: str, requirements: Iterable[str], *, complete: bool
) -> Path:
    """Write the wheel into `folder`; the same files give the same bytes."""
    info = f"{NAME}-{version}.dist-info"
    metadata = ["Metadata-Version: 2.1", f"Name: {NAME}", f"Version: {version}"]
    metadata += ["Requires-Python: >=3.11", *(f"Requires-Dist: {r}" for r in requirements), ""]
    wheel = ["Wheel-Version: 1.0", "Generator: rcdeploy", "Root-Is-Purelib: true"]
    members = [(f.name, f.source.read_bytes()) for f in package_files(complete=complete)]
    members.append((f"{info}/METADATA", "\n".join(metadata).encode()))
    members.append((f"{info}/WHEEL", "\n".join([*wheel, "Tag: py3-none-any", ""]).encode()))
    return write_wheel(folder / f"{NAME}-{version}-py3-none-any.whl", info, members)


def write_wheel(
    path: Path,
    info: str,
    members: Iterable[tuple[str, bytes]],
    executable: frozenset[str] = frozenset(),
) -> Path:
    """Write a wheel with `members` and their RECORD, at once; `info` is its dist-info folder."""
    draft = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    record = []
    with zipfile.ZipFile(draft, "w", zipfile.ZIP_DEFLATED, compresslevel=_LEVEL) as archive:
        for name, content in members:
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=")
            record.append(f"{_quote(name)},sha256={digest.decode()},{len(content)}")
            _add(archive, name, content, executable=name in executable)
        record += [f"{info}/RECORD,,", ""]
        _add(archive, f"{info}/RECORD", "\n".join(record).encode(), executable=False)
    draft.replace(path)
    return path


def _add(archive: zipfile.ZipFile, name: str, content: bytes, *, executable: bool) -> None:
    entry = zipfile.ZipInfo(name, _ZIP_TIME)
    entry.external_attr = (0o100755 if executable else 0o100644) << 16
    archive.writestr(entry, content, zipfile.ZIP_DEFLATED, _LEVEL)


def _quote(name: str) -> str:
    return '"' + name.replace('"', '""') + '"' if "," in name or '"' in name else name


def _files_below(folder: Path, name: str) -> Iterator[PackageFile]:
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.name in _LEFT_OUT or entry.name.endswith((".pyc", ".pyo")):
                continue
            inner = f"{name}/{entry.name}"
            if entry.is_dir():
                yield from _files_below(Path(entry.path), inner)
            elif entry.is_file():
                yield PackageFile(inner, Path(entry.path))


def _shared(root: Path, name: str) -> Iterator[PackageFile]:
    """Grammars, templates and interfaces, of a wheel or of a checkout."""
    for folder in (root / "share" / name, root.parent / name):
        if folder.is_dir():
            yield from _files_below(folder, f"{NAME}/share/{name}")
            return
