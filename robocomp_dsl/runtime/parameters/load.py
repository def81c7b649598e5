"""Loads a configuration file.

In: the path, the overrides of the command line, the schema. Out: the values, or `ConfigError` with
all problems. The only module of this package that reads files.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.regular_file import open_regular
from robocomp_dsl.runtime.parameters import overrides as command_line
from robocomp_dsl.runtime.parameters import saved
from robocomp_dsl.runtime.parameters.check import check_values
from robocomp_dsl.runtime.parameters.default_lists import with_default_lists
from robocomp_dsl.runtime.parameters.errors import ConfigError
from robocomp_dsl.runtime.parameters.properties_text import is_properties, read_properties
from robocomp_dsl.runtime.parameters.robocomp_keys import (
    ConnectionKeys,
    read_connection_keys,
    without_connection_keys,
)
from robocomp_dsl.runtime.parameters.schema import Schema
from robocomp_dsl.runtime.parameters.tree import Mapping, Scalar, TextSyntax

log = logging.getLogger("robocomp.config")
MAX_BYTES = 1024 * 1024
"""Larger files are rejected; a configuration has a few kilobytes."""


def load_values(
    schema: Schema, path: Path | None, overrides: Iterable[str], saved_file: Path | None = None
) -> dict[str, Any]:
    """The values of the file at `path` and of `overrides`. Raises `ConfigError`.

    `saved_file` is the file of saved live values; it may be missing.
    """
    findings: list[Finding] = []
    root = _read(path, findings)
    if root is not None and saved_file is not None and saved_file.exists():
        values_kept = _read(saved_file, findings)
        root = saved.apply(root, values_kept, findings) if values_kept else None
    if root is not None:
        root = without_connection_keys(root, {entry.name for entry in schema})
        if path is not None and _is_properties_tree(root):
            root = _without_unknown(root, schema, path)
    if root is not None:  # otherwise every required parameter would be reported as missing
        written = list(overrides)
        root = with_default_lists(root, schema, written)
        root = command_line.apply(root, written, findings)
        values = check_values(root, schema, findings)
        if not findings:
            return values
    raise ConfigError(sorted(findings, key=_reading_order))


def _is_properties_tree(root: Mapping) -> bool:
    """Whether a tree was read from RoboComp's text format, whose values have no types."""
    values = [member.value for member in root.members.values()]
    return any(
        value.style is TextSyntax.RAW
        if isinstance(value, Scalar)
        else isinstance(value, Mapping) and _is_properties_tree(value)
        for value in values
    )


def _without_unknown(root: Mapping, schema: Schema, path: Path) -> Mapping:
    """Old configurations hold keys of libraries and of other versions: these are no errors."""
    known = {entry.name for entry in schema}
    unknown = [name for name in root.members if name not in known]
    if unknown:
        log.warning("%s: ignored keys that are no parameters: %s", path, ", ".join(unknown))
    parameters = {name: member for name, member in root.members.items() if name in known}
    return Mapping(root.place, parameters)


def load_connection_keys(path: Path | None) -> ConnectionKeys:
    """The keys of a configuration that are about connections; none if it cannot be read."""
    root = _read(path, [])
    return read_connection_keys(root) if root else ConnectionKeys()


def _reading_order(finding: Finding) -> tuple[bool, int, int]:
    location = finding.location
    return location.file == command_line.SOURCE_NAME, location.line, location.column


def _read(path: Path | None, findings: list[Finding]) -> Mapping | None:
    if path is None:
        return Mapping(Location(SourceText("(no configuration file)", ()), 1, 1))
    try:
        source = read_text(path)
    except UnreadableFile as error:
        place = Location(SourceText(str(path), ()), 1, 1)
        findings.append(Finding(place, f"unreadable configuration: {error}"))
        return None
    text = SourceText.of_text(path, source)
    # A component without a file needs no reader; that of YAML takes long to load.
    if is_properties(source) and path.suffix.lower() not in _SUFFIXES:
        return read_properties(text, source, findings)
    if path.suffix.lower() == ".toml":
        from robocomp_dsl.runtime.parameters.toml_text import read_toml  # noqa: PLC0415

        return read_toml(text, source, findings)
    from robocomp_dsl.runtime.parameters.yaml_text import read_yaml  # noqa: PLC0415

    return read_yaml(text, source, findings)


_SUFFIXES = (".toml", ".yaml", ".yml", ".json")
"""Suffixes of files that are in no other format."""


class UnreadableFile(Exception):
    """A file that cannot be read as text; the message says why."""


def read_text(path: Path) -> str:
    """The text of a file. Raises `UnreadableFile`."""
    try:
        with open_regular(path) as stream:
            data = stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise UnreadableFile("file not found") from None
    except IsADirectoryError:
        raise UnreadableFile("this is a folder, not a file") from None
    except (OSError, ValueError) as error:
        raise UnreadableFile(getattr(error, "strerror", None) or str(error)) from None
    if len(data) > MAX_BYTES:
        raise UnreadableFile(f"it is larger than {MAX_BYTES // 1024} kB")
    if b"\0" in data:
        raise UnreadableFile("this is a binary file, not text")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UnreadableFile(
            f"the text is not UTF-8: byte 0x{data[error.start]:02x} at offset {error.start}"
        ) from None
