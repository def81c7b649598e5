"""Finds the files that an instance names outside or inside its component's folder.

In: an instance, its process and what the deployment adds. Out: paths, as the component sees them.
Reads folders only to see what exists.
"""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.model.deployment import Connection, Instance

_LONGEST_PATH = 4096
_REFERENCE = re.compile(r"(?:^model|\bfile)\s*:\s*[\"']?([^\s\"',{}#]+)", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class NamedFile:
    """A file or folder to copy. `text` is its path in the command line, empty if it is not there.

    `required`: it is an error if it does not exist.
    """

    path: Path
    text: str = ""
    required: bool = True


@dataclass(frozen=True, slots=True)
class NamedFiles:
    """What an instance names; `folders` exist on the host even if they are empty."""

    files: tuple[NamedFile, ...]
    folders: tuple[Path, ...]


class NamedFileFinder:
    """Finds named files; folders and command lines that instances share are looked at once.

    `description` is the DDSL file.
    """

    def __init__(self, description: Path, connections: Sequence[Connection]) -> None:
        self._folder = description.parent.resolve()
        self._resolved: dict[Path, Path] = {}
        self._programs: dict[tuple[str, Path], tuple[NamedFile, ...]] = {}
        self._monitors: dict[str, list[NamedFile]] = {}
        for connection in connections:
            for monitor in connection.monitors:
                end = connection.source if monitor.position == "sender" else connection.target
                path = Path(monitor.file).resolve()
                self._monitors.setdefault(end.full_name, []).append(NamedFile(path, str(path)))

    def resolve(self, folder: Path) -> Path:
        """The folder without symbolic links."""
        if folder not in self._resolved:
            self._resolved[folder] = folder.resolve()
        return self._resolved[folder]

    def find(self, instance: Instance, folder: Path, config: Path | None) -> NamedFiles:
        """Files of the configuration, `files`, `set`, monitors and the command line.

        `folder` is that of the component, resolved; `config` is what the instance reads.
        """
        files = [NamedFile(place_of(config), str(config))] if config else []
        files += [NamedFile(place_of(folder / path), str(path)) for path in instance.files]
        for path in instance.setting_paths:
            files.append(NamedFile(place_of(path), str(path)))
            files += _referenced_files(path)
        files += self._monitors.get(instance.full_name, ())
        key = (instance.executable, folder)
        if key not in self._programs:
            self._programs[key] = tuple(_program_files(*key))
        files += self._programs[key]
        bases = [config.absolute().parent] if config else []
        bases += [folder, self._folder]
        folders = []
        for text in _texts(instance):
            files += _value_files(text, bases, folder)
            if text.startswith(("../", "./")):
                folders.append(place_of(folder / text).parent)
        return NamedFiles(tuple(dict.fromkeys(files)), tuple(dict.fromkeys(folders)))


def place_of(path: Path) -> Path:
    """The absolute path without links in its folder; the last part may be a link."""
    path = Path(os.path.normpath(path.absolute())) if path.name in ("..", "") else path
    return path.parent.resolve() / path.name


def _program_files(executable: str, folder: Path) -> Iterator[NamedFile]:
    """Files that the words of `executable` name, relative to the folder or in it."""
    for word in shlex.split(executable):
        path = folder / word
        is_absolute = Path(word).is_absolute()
        if path.is_file() and (not is_absolute or path.is_relative_to(folder)):
            yield NamedFile(place_of(path), word if is_absolute else "")


def _referenced_files(path: Path) -> Iterator[NamedFile]:
    """The model and the taxel positions that a tactile description names, relative to it."""
    if path.suffix.lower() not in (".yaml", ".yml"):
        return
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return
    for name in _REFERENCE.findall(text):
        if _exists(path.parent / name, folders=False):
            yield NamedFile(place_of(path.parent / name), required=False)


def _texts(instance: Instance) -> Iterator[str]:
    """The texts among the values of `set` and of devices."""
    settings = [value for _, value in instance.settings]
    values = [v for value in settings for v in (value if isinstance(value, tuple) else (value,))]
    values += [v for device in instance.devices.devices for _, v in device.parameters]
    for value in values:
        text = value if isinstance(value, str) else ""
        if text and len(text) <= _LONGEST_PATH and "\0" not in text and "://" not in text:
            yield text


def _value_files(text: str, bases: Sequence[Path], folder: Path) -> Iterator[NamedFile]:
    """The files that a value names; a folder only if the value has a slash."""
    if Path(text).is_absolute():
        path = Path(text)
        homes = [home for home in (folder.parent, *bases, Path.home()) if home != home.parent]
        if any(path.is_relative_to(home) for home in homes) and _exists(path, folders=False):
            yield NamedFile(place_of(path), text, required=False)
        return
    for base in bases:
        path = base / text
        if _exists(path, folders="/" in text) and not folder.is_relative_to(path.resolve()):
            yield NamedFile(place_of(path), required=False)


def _exists(path: Path, *, folders: bool) -> bool:
    try:
        return path.is_file() or (folders and path.is_dir())
    except OSError:  # a name that is too long, say
        return False
