"""Loads a configuration file.

In: the path, the overrides of the command line, the schema. Out: the values, or `ConfigError` with
all problems. The only module of this package that reads files.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.regular_file import open_regular
from robocomp_dsl.runtime.parameters import overrides as command_line
from robocomp_dsl.runtime.parameters import saved
from robocomp_dsl.runtime.parameters.check import check_values
from robocomp_dsl.runtime.parameters.errors import ConfigError
from robocomp_dsl.runtime.parameters.schema import Schema
from robocomp_dsl.runtime.parameters.tree import Mapping

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
    if root is not None:  # otherwise every required parameter would be reported as missing
        root = command_line.apply(root, overrides, findings)
        values = check_values(root, schema, findings)
        if not findings:
            return values
    raise ConfigError(sorted(findings, key=_reading_order))


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
    if path.suffix.lower() == ".toml":
        from robocomp_dsl.runtime.parameters.toml_text import read_toml  # noqa: PLC0415

        return read_toml(text, source, findings)
    from robocomp_dsl.runtime.parameters.yaml_text import read_yaml  # noqa: PLC0415

    return read_yaml(text, source, findings)


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
