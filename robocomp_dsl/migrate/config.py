"""Read configurations of old components: one entry per key, for both file formats.

In: a file in the old text format (`key = value`, as Ice reads it) or in TOML. Out: a `Config`, and
findings about lines without effect.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.regular_file import open_regular
from robocomp_dsl.source import MAX_BYTES, Source, Span, UnreadableSource

Value: TypeAlias = Any
"""A string in the text format; bool, int, float, str, list, dates or tables in lists in TOML."""

MAX_ENTRIES = 10_000
"""A file with more keys is not a configuration of a component."""

_BINARY = re.compile(rb"[\x00-\x08\x0e-\x1f]|[\xfe\xff]{2}")
_BEFORE_COMMENT = re.compile(r"""^(?:"(?:\\.|[^"\\])*"|'[^']*'|[^"'#])*""")
"""A line up to its trailing comment."""
_HEADER = re.compile(r"\s*\[\[?([^\]]*)\]\]?")
_CAPITALISED_BOOL = re.compile(
    r"^([^\n\"'#]*=[ \t]*)(True|False)(?=[ \t\r]*(?:#.*)?$)", re.MULTILINE
)
"""Python's spelling of TOML's `true` and `false`; RoboComp reads both."""
_TOML_POSITION = re.compile(r"\(at line (\d+), column (\d+)\)")


@dataclass(frozen=True, slots=True)
class ConfigEntry:
    """One key with its value. `path` is the key split at its dots; `doc` the comment above it."""

    path: tuple[str, ...]
    value: Value
    span: Span
    doc: str = ""

    @property
    def key(self) -> str:
        """The key as it is written."""
        return ".".join(self.path)


@dataclass(frozen=True, slots=True)
class Config:
    """One file. `typed` means TOML, where values have types; in the text format all are strings."""

    source: Source
    typed: bool
    entries: tuple[ConfigEntry, ...]

    @property
    def path(self) -> Path:
        """The path of the file."""
        return self.source.path


def read_source(path: Path, report: Report) -> Source:
    """The text of a configuration; a file that is not UTF-8 is read as Latin-1 and reported.

    Raises `UnreadableSource` for a binary file.
    """
    try:
        return Source.read(path)
    except UnreadableSource:
        with suppress(OSError), open_regular(path) as stream:
            data = stream.read(MAX_BYTES + 1)
            if len(data) <= MAX_BYTES and not _BINARY.search(data) and path.suffix != ".toml":
                source = Source(path, data.decode("iso-8859-1"))
                message = f"`{path.name}` is not UTF-8 and was read as Latin-1"
                report.add(codes.NOT_UTF8, source.file_span, message)
                return source
        raise


def read_config(source: Source, report: Report) -> Config | None:
    """The entries of a file; None, with a finding, for a file that cannot be used."""
    typed = source.path.suffix.lower() == ".toml"
    parsed = _parse_toml(source, report) if typed else _parse_text(source, report)
    if parsed is None:
        return None
    entries = list(parsed)
    if len(entries) > MAX_ENTRIES:
        message = f"`{source.path.name}` has {len(entries)} keys, so it is not a configuration"
        report.add(codes.UNREADABLE_FILE, source.file_span, message)
        return None
    return Config(source, typed, tuple(_last_occurrences(entries, report)))


def _last_occurrences(entries: list[ConfigEntry], report: Report) -> Iterator[ConfigEntry]:
    last = {entry.path: entry for entry in entries}
    for entry in entries:
        winner = last[entry.path]
        if winner is entry:
            yield entry
        else:
            report.add(
                codes.DUPLICATE_KEY,
                entry.span,
                f"`{entry.key}` is set twice; this value is ignored",
                notes=(Note(winner.span, "the last value is here"),),
            )


def _parse_text(source: Source, report: Report) -> Iterator[ConfigEntry]:
    """Parse as Ice does: `#` begins a comment, a backslash escapes (Ice manual, properties)."""
    comments: list[str] = []
    for number in range(1, len(source.line_starts) + 1):
        line = source.line(number)
        code, comment = _split_comment(line)
        if not code:
            comments = [*comments, *filter(None, [_comment_text(comment)])] if comment else []
            continue
        start = source.line_starts[number - 1] + len(line) - len(line.lstrip())
        span = source.span(start, start + len(line.strip()))
        key, equals, value = (part.strip() for part in code.partition("="))
        path = tuple(part for part in key.split(".") if part)
        if not equals or not path:
            message = f"`{code:.60}` has no `=`" if not equals else "there is no key before `=`"
            report.add(codes.INVALID_CONFIG_LINE, span, message)
        else:
            yield ConfigEntry(path, _unquote(value), span, "\n".join(comments) or comment)
        comments = []


def _split_comment(line: str) -> tuple[str, str]:
    """A line without its comment and escapes, and the comment."""
    code: list[str] = []
    position = 0
    while position < len(line):
        if line[position] == "\\" and line[position + 1 : position + 2] in ("#", "\\", "="):
            position += 1
        elif line[position] == "#":
            return "".join(code).strip(), line[position:].strip("# \t")
        code.append(line[position])
        position += 1
    return "".join(code).strip(), ""


def _unquote(value: str) -> str:
    """A value without its quotes, which the newer text format has."""
    inner = value[1:-1]
    return inner if len(value) > 1 and value[0] == value[-1] == '"' and '"' not in inner else value


def _parse_toml(source: Source, report: Report) -> Iterator[ConfigEntry] | None:
    text = source.text.replace("\r\n", "\n")
    try:
        tree = tomllib.loads(_CAPITALISED_BOOL.sub(lambda m: m[1] + m[2].lower(), text))
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        message = _TOML_POSITION.sub("", str(error)).strip() or "it is nested too deeply"
        span = _error_span(str(error), source)
        report.add(codes.UNREADABLE_FILE, span, f"`{source.path.name}` is not TOML: {message}")
        return None
    for match in _CAPITALISED_BOOL.finditer(source.text):
        message = f"`{match[2]}` is not TOML; it was read as `{match[2].lower()}`"
        report.add(codes.CAPITALISED_BOOL, source.span(*match.span(2)), message)
    return _flatten(tree, (), _key_positions(source), source)


def _error_span(message: str, source: Source) -> Span:
    """The line of an error of `tomllib`; before Python 3.14 only its message holds the line."""
    last = len(source.line_starts)
    found = _TOML_POSITION.search(message)
    number = int(found[1]) if found else last if "end of document" in message else 0
    if not 1 <= number <= last:
        return source.file_span
    start = source.line_starts[number - 1]
    return source.span(start, start + len(source.line(number)))


def _flatten(
    tree: dict[str, Value],
    path: tuple[str, ...],
    places: dict[tuple[str, ...], tuple[Span, str]],
    source: Source,
) -> Iterator[ConfigEntry]:
    for key, value in tree.items():
        below = (*path, key)
        if isinstance(value, dict):
            yield from _flatten(value, below, places, source)
        else:
            span, doc = places.get(below, (source.file_span, ""))
            yield ConfigEntry(below, value, span, doc)


def _key_positions(source: Source) -> dict[tuple[str, ...], tuple[Span, str]]:
    """The position of each key and its comment; keys in unusual syntax are left out.

    The comment is above the key or after the value, where it may continue in indented lines.
    """
    positions: dict[tuple[str, ...], tuple[Span, str]] = {}
    table: tuple[str, ...] = ()
    comments: list[str] = []
    commented: tuple[str, ...] | None = None
    for number in range(1, len(source.line_starts) + 1):
        line = source.line(number)
        bare = line.strip()
        comment = _comment_text(bare) if bare.startswith("#") else ""
        if bare.startswith("#") and commented and line[0] in " \t":
            span, doc = positions[commented]
            positions[commented] = (span, f"{doc}\n{comment}" if comment else doc)
            continue
        commented = None
        if header := _HEADER.fullmatch(line.partition("#")[0].rstrip()):
            table, comments = _split_key(header[1]), []
        elif bare.startswith("#"):
            comments += [comment] if comment else []
        elif "=" in bare:
            start = source.line_starts[number - 1] + len(line) - len(line.lstrip())
            path = (*table, *_split_key(bare.partition("=")[0]))
            doc = "\n".join(comments) or _comment_text(_BEFORE_COMMENT.sub("", bare))
            commented = path if doc and not comments and path not in positions else None
            positions.setdefault(path, (source.span(start, start + len(bare)), doc))
            comments = []
        else:
            comments = []
    return positions


def _comment_text(comment: str) -> str:
    """The text of a comment line without decoration; empty for a line of decoration only."""
    bare = comment.strip("# \t\u2500\u2550")
    return bare if any(c.isalnum() for c in bare) else ""


def _split_key(text: str) -> tuple[str, ...]:
    return tuple(part.strip().strip("\"'") for part in text.split(".") if part.strip())
