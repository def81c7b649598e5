"""A configuration file to values.

In: the path, the overrides of the command line, the schema. Out: the values, or `ConfigError` with
everything that is wrong. The only place here that touches the file system.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime.parameters import overrides as command_line
from robocomp_dsl.runtime.parameters import saved
from robocomp_dsl.runtime.parameters.check import check
from robocomp_dsl.runtime.parameters.findings import ConfigError, Finding, Place, Text
from robocomp_dsl.runtime.parameters.schema import Schema
from robocomp_dsl.runtime.parameters.tree import Mapping

MAX_BYTES = 1024 * 1024
"""Larger files are refused; a configuration of a component has a few kilobytes."""


def load_values(
    schema: Schema, path: Path | None, overrides: Iterable[str], kept: Path | None = None
) -> dict[str, Any]:
    """The values that `path` and `overrides` give to `schema`. Raises `ConfigError`.

    `kept` is the file of live values that were saved; it need not be there.
    """
    findings: list[Finding] = []
    root = _read(path, findings)
    if root is not None and kept is not None and kept.exists():
        values_kept = _read(kept, findings)
        root = saved.apply(root, values_kept, findings) if values_kept else None
    if root is not None:  # else every required parameter would be told missing, too
        root = command_line.apply(root, overrides, findings)
        values = check(root, schema, findings)
        if not findings:
            return values
    raise ConfigError(sorted(findings, key=_reading_order))


def _reading_order(finding: Finding) -> tuple[bool, int, int]:
    place = finding.place
    return place.text.name == command_line.NAME, place.line, place.column


def _read(path: Path | None, findings: list[Finding]) -> Mapping | None:
    if path is None:
        return Mapping(Place(Text("(no configuration file)", ()), 1, 1))
    try:
        source = decoded(path)
    except Unreadable as error:
        place = Place(Text(str(path), ()), 1, 1)
        findings.append(Finding(place, f"the configuration cannot be used: {error}"))
        return None
    text = Text(str(path), tuple(source.splitlines()))
    # A component without a file needs no reader; that of YAML takes long to load.
    if path.suffix.lower() == ".toml":
        from robocomp_dsl.runtime.parameters.toml_text import read_toml  # noqa: PLC0415

        return read_toml(text, source, findings)
    from robocomp_dsl.runtime.parameters.yaml_text import read_yaml  # noqa: PLC0415

    return read_yaml(text, source, findings)


class Unreadable(Exception):
    """A file that is no text of ours; the message says why."""


def decoded(path: Path) -> str:
    """The text of a file. Raises `Unreadable`."""
    try:
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise Unreadable("there is no such file") from None
    except IsADirectoryError:
        raise Unreadable("this is a folder, not a file") from None
    except (OSError, ValueError) as error:
        raise Unreadable(getattr(error, "strerror", None) or str(error)) from None
    if len(data) > MAX_BYTES:
        raise Unreadable(f"it is larger than {MAX_BYTES // 1024} kB")
    if b"\0" in data:
        raise Unreadable("this is a binary file, not a text")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unreadable(
            f"the text is not UTF-8: byte 0x{data[error.start]:02x} at offset {error.start}"
        ) from None
