"""Makes a wheel of an installed distribution, from the files that its RECORD lists.

In: a distribution of this Python. Out: a wheel, or None if it cannot be made: a file was changed
after the installation. The same installation gives the same bytes.
"""

from __future__ import annotations

import base64
import csv
import hashlib
import re
from collections.abc import Iterator
from importlib.metadata import Distribution
from pathlib import Path, PurePosixPath

from robocomp_dsl.deploy.content.package_files import write_wheel

_INSTALLER_FILES = frozenset(
    {"INSTALLER", "REQUESTED", "direct_url.json", "RECORD", "uv_cache.json"}
)
_SHEBANG = re.compile(rb"#!.*python[0-9.]*[^\n]*")
_SECTION = re.compile(r"\[(?:console|gui)_scripts\]\s*\n(.*?)(?=\n\[|\Z)", re.DOTALL)


def installed_tags(installed: Distribution) -> frozenset[str]:
    """The tags of the wheel that was installed."""
    lines = (installed.read_text("WHEEL") or "").splitlines()
    return frozenset(line.partition(":")[2].strip() for line in lines if line.startswith("Tag:"))


def repack(installed: Distribution, folder: Path) -> Path | None:
    """Write the wheel into `folder`; None if the installation is not as it was installed."""
    info = _info_folder(installed)
    tags = installed_tags(installed)
    if info is None or not tags:
        return None
    members: list[tuple[str, bytes]] = []
    executable = set()
    for name, path, digest in _recorded(installed, info):
        try:
            content = path.read_bytes()
        except OSError:
            return None
        if digest and _digest(content) != digest:
            return None
        if name.split("/")[0].endswith(".data") and "/scripts/" in name:
            content = (
                _SHEBANG.sub(b"#!python", content, count=1) if content[:2] == b"#!" else content
            )
            executable.add(name)
        elif path.stat().st_mode & 0o111:
            executable.add(name)
        members.append((name, content))
    stem = info.removesuffix(".dist-info")
    file_name = f"{stem}-{_compressed(tags)}.whl"
    return write_wheel(folder / file_name, info, sorted(members), frozenset(executable))


def _info_folder(installed: Distribution) -> str | None:
    for file in installed.files or ():
        if file.name == "METADATA" and len(file.parts) == 2:
            return file.parts[0]
    return None


def _recorded(installed: Distribution, info: str) -> Iterator[tuple[str, Path, str]]:
    """Name in the wheel, place here and hash of each file that belongs into the wheel."""
    text = installed.read_text("RECORD") or ""
    generated = _generated_scripts(installed)
    for row in csv.reader(text.splitlines()):
        name, digest = row[0], row[1] if len(row) > 1 else ""
        path = PurePosixPath(name)
        if name.endswith(".pyc") or (path.parts[0] == info and path.name in _INSTALLER_FILES):
            continue
        place = Path(str(installed.locate_file(name)))
        if ".." not in path.parts:
            yield name, place, digest
        elif wheel_name := _data_name(path, info, generated):
            yield wheel_name, place, digest if "/scripts/" not in wheel_name else ""


def _data_name(path: PurePosixPath, info: str, generated: frozenset[str]) -> str | None:
    """Where a file outside of site-packages is in a wheel; None for generated scripts."""
    data = info.removesuffix(".dist-info") + ".data"
    rest = [part for part in path.parts if part != ".."]
    if rest[0] == "bin":
        return None if path.name in generated else f"{data}/scripts/{path.name}"
    return f"{data}/data/{'/'.join(rest)}"


def _generated_scripts(installed: Distribution) -> frozenset[str]:
    """Scripts that the installer writes by the entry points."""
    sections = _SECTION.findall(installed.read_text("entry_points.txt") or "")
    lines = (line for section in sections for line in section.splitlines())
    return frozenset(line.partition("=")[0].strip() for line in lines if "=" in line)


def _digest(content: bytes) -> str:
    encoded = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=")
    return f"sha256={encoded.decode()}"


def _compressed(tags: frozenset[str]) -> str:
    """Tags as in file names: `cp311-cp311-manylinux_2_17_x86_64.manylinux2014_x86_64`."""
    parts = zip(*(tag.split("-") for tag in tags), strict=True)
    return "-".join(".".join(sorted(set(part))) for part in parts)
