"""Configurations of old components as data: one entry per key, whatever the form of the file.

In: a file in the old text form (`key = value`, as Ice reads it) or in TOML. Out: a `Config`, and
findings about lines that say nothing.
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
from robocomp_dsl.source import MAX_BYTES, Source, Span, UnreadableSource

Value: TypeAlias = Any
"""A text of the text form; what TOML has: bool, int, float, str, list, dates, tables in lists."""

MOST_ENTRIES = 10_000
"""More keys than this are no configuration of a component."""

_NO_TEXT = re.compile(rb"[\x00-\x08\x0e-\x1f]|[\xfe\xff]{2}")
_BEHIND = re.compile(r"""^(?:"(?:\\.|[^"\\])*"|'[^']*'|[^"'#])*""")
"""A line up to the comment behind it."""
_HEADER = re.compile(r"\s*\[\[?([^\]]*)\]\]?")
_CAPITAL = re.compile(r"^([^\n\"'#]*=[ \t]*)(True|False)(?=[ \t\r]*(?:#.*)?$)", re.MULTILINE)
"""What Python writes for the values that TOML has in small letters; RoboComp read both."""
_LOCATED = re.compile(r"\(at line (\d+), column (\d+)\)")


@dataclass(frozen=True, slots=True)
class Entry:
    """One key with its value. `path` is the key cut at its dots; `doc` the comment above it."""

    path: tuple[str, ...]
    value: Value
    span: Span
    doc: str = ""

    @property
    def key(self) -> str:
        """As it is written."""
        return ".".join(self.path)


@dataclass(frozen=True, slots=True)
class Config:
    """One file. `typed` is TOML, where values have types; in the text form all are texts."""

    source: Source
    typed: bool
    entries: tuple[Entry, ...]

    @property
    def path(self) -> Path:
        """Where it stands."""
        return self.source.path


def read_source(path: Path, report: Report) -> Source:
    """The text of a configuration; one that is no UTF-8 is taken for Latin-1, which is told.

    Raises `UnreadableSource` for what is no text.
    """
    try:
        return Source.read(path)
    except UnreadableSource:
        with suppress(OSError), path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
            if len(data) <= MAX_BYTES and not _NO_TEXT.search(data) and path.suffix != ".toml":
                source = Source(path, data.decode("iso-8859-1"))
                said = f"`{path.name}` is not UTF-8 and was read as Latin-1"
                report.add(codes.NOT_UTF8, source.whole, said)
                return source
        raise


def read_config(source: Source, report: Report) -> Config | None:
    """The entries of a file; None where it is TOML that cannot be read, which is told."""
    typed = source.path.suffix.lower() == ".toml"
    found = _toml(source, report) if typed else _text(source, report)
    if found is None:
        return None
    entries = list(found)
    if len(entries) > MOST_ENTRIES:
        said = f"`{source.path.name}` has {len(entries)} keys, which is no configuration"
        report.add(codes.UNREADABLE_FILE, source.whole, said)
        return None
    return Config(source, typed, tuple(_last_ones(entries, report)))


def _last_ones(entries: list[Entry], report: Report) -> Iterator[Entry]:
    last = {one.path: one for one in entries}
    for one in entries:
        winner = last[one.path]
        if winner is one:
            yield one
        else:
            report.add(
                codes.CONFIG_TWICE,
                one.span,
                f"`{one.key}` is given twice; this value does not count",
                notes=(Note(winner.span, "the last one is here"),),
            )


def _text(source: Source, report: Report) -> Iterator[Entry]:
    """As Ice reads a file: `#` begins a comment, a backslash escapes (Ice manual, properties)."""
    comments: list[str] = []
    for number in range(1, len(source.line_starts) + 1):
        line = source.line(number)
        code, comment = _cut(line)
        if not code:
            comments = [*comments, *filter(None, [_words(comment)])] if comment else []
            continue
        start = source.line_starts[number - 1] + len(line) - len(line.lstrip())
        span = source.span(start, start + len(line.strip()))
        key, sign, value = (part.strip() for part in code.partition("="))
        path = tuple(part for part in key.split(".") if part)
        if not sign or not path:
            said = f"`{code:.60}` has no `=`" if not sign else "there is no key before the `=`"
            report.add(codes.CONFIG_LINE, span, said)
        else:
            yield Entry(path, _unquoted(value), span, "\n".join(comments) or comment)
        comments = []


def _cut(line: str) -> tuple[str, str]:
    """A line without its comment and escapes, and the comment."""
    made: list[str] = []
    at = 0
    while at < len(line):
        if line[at] == "\\" and line[at + 1 : at + 2] in ("#", "\\", "="):
            at += 1
        elif line[at] == "#":
            return "".join(made).strip(), line[at:].strip("# \t")
        made.append(line[at])
        at += 1
    return "".join(made).strip(), ""


def _unquoted(value: str) -> str:
    """A value without the quotes around it, which the newer text form has."""
    inner = value[1:-1]
    return inner if len(value) > 1 and value[0] == value[-1] == '"' and '"' not in inner else value


def _toml(source: Source, report: Report) -> Iterator[Entry] | None:
    text = source.text.replace("\r\n", "\n")
    try:
        tree = tomllib.loads(_CAPITAL.sub(lambda m: m[1] + m[2].lower(), text))
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        said = _LOCATED.sub("", str(error)).strip() or "it is nested too deeply"
        where = _place_of(str(error), source)
        report.add(codes.UNREADABLE_FILE, where, f"`{source.path.name}` is no TOML: {said}")
        return None
    for one in _CAPITAL.finditer(source.text):
        said = f"`{one[2]}` is no TOML, and was read as `{one[2].lower()}`"
        report.add(codes.CAPITAL, source.span(*one.span(2)), said)
    return _leaves(tree, (), _places(source), source)


def _place_of(message: str, source: Source) -> Span:
    """The line that a message of `tomllib` names, which is only in its text before Python 3.14."""
    last = len(source.line_starts)
    found = _LOCATED.search(message)
    number = int(found[1]) if found else last if "end of document" in message else 0
    if not 1 <= number <= last:
        return source.whole
    start = source.line_starts[number - 1]
    return source.span(start, start + len(source.line(number)))


def _leaves(
    tree: dict[str, Value],
    path: tuple[str, ...],
    places: dict[tuple[str, ...], tuple[Span, str]],
    source: Source,
) -> Iterator[Entry]:
    for key, value in tree.items():
        below = (*path, key)
        if isinstance(value, dict):
            yield from _leaves(value, below, places, source)
        else:
            span, doc = places.get(below, (source.whole, ""))
            yield Entry(below, value, span, doc)


def _places(source: Source) -> dict[tuple[str, ...], tuple[Span, str]]:
    """Where each key stands, and its comment; what is written strangely is left out.

    That is the comment above it, else the one behind it, which may go on in indented lines.
    """
    found: dict[tuple[str, ...], tuple[Span, str]] = {}
    table: tuple[str, ...] = ()
    comments: list[str] = []
    behind: tuple[str, ...] | None = None
    for number in range(1, len(source.line_starts) + 1):
        line = source.line(number)
        bare = line.strip()
        said = _words(bare) if bare.startswith("#") else ""
        if bare.startswith("#") and behind and line[0] in " \t":
            span, doc = found[behind]
            found[behind] = (span, f"{doc}\n{said}" if said else doc)
            continue
        behind = None
        if header := _HEADER.fullmatch(line.partition("#")[0].rstrip()):
            table, comments = _dotted(header[1]), []
        elif bare.startswith("#"):
            comments += [said] if said else []
        elif "=" in bare:
            start = source.line_starts[number - 1] + len(line) - len(line.lstrip())
            path = (*table, *_dotted(bare.partition("=")[0]))
            doc = "\n".join(comments) or _words(_BEHIND.sub("", bare))
            behind = path if doc and not comments and path not in found else None
            found.setdefault(path, (source.span(start, start + len(bare)), doc))
            comments = []
        else:
            comments = []
    return found


def _words(comment: str) -> str:
    """A line of a comment without what frames it; nothing of a line that only frames."""
    bare = comment.strip("# \t\u2500\u2550")
    return bare if any(c.isalnum() for c in bare) else ""


def _dotted(text: str) -> tuple[str, ...]:
    return tuple(part.strip().strip("\"'") for part in text.split(".") if part.strip())
