"""A Python module as source and syntax tree. The file is only read.

In: a path. Out: a `PythonModule`; `UnreadableSource` for a file that is not text.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

from robocomp_dsl.record import Record
from robocomp_dsl.source import MAX_BYTES, Source, Span, UnreadableSource

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef
"""Syntax nodes of functions."""

_LINE_END = re.compile(r"\r\n?|\n")
"""Python's line terminators."""

_KEYWORDS = re.compile(r"(?:async[\s\\]+)?(?:def|class)[\s\\]+")
"""The text before the name of a function or a class."""


class PythonModule(Record):
    """A module that Python can parse; `data` are the bytes of its file."""

    source: Source
    data: bytes
    encoding: str
    tree: ast.Module
    __slots__ = ("__dict__",)  # for cached properties

    @cached_property
    def _near(self) -> dict[str, PythonModule | None]:
        return {}

    @cached_property
    def starts(self) -> list[int]:
        """Offset of the first character of every line, with Python's line numbering."""
        return [0, *(m.end() for m in _LINE_END.finditer(self.source.text))]

    def offset(self, line: int, column: int) -> int:
        """A position in the text: `line` from 1, `column` in UTF-8 bytes from 0, as in `ast`."""
        start = self.starts[line - 1]
        # A character has at least one byte, so at most as many characters as bytes are decoded.
        ahead = self.source.text[start : start + column].encode("utf-8", "surrogatepass")
        return start + len(ahead[:column].decode("utf-8", "replace"))

    def span_of(self, node: ast.ClassDef | Function) -> Span:
        """The span of a class's or function's name, which the syntax tree lacks."""
        start = self.offset(node.lineno, node.col_offset)
        found = _KEYWORDS.match(self.source.text, start)
        at = found.end() if found else start
        return self.source.span(at, at + len(node.name))

    def beside(self, name: str) -> PythonModule | None:
        """The module of this dotted name in the same folder, if Python can read it."""
        if name not in self._near:
            path = self.source.path.parent.joinpath(*name.split("."))
            places = (path.with_name(f"{path.name}.py"), path / "__init__.py")
            self._near[name] = next(filter(None, map(_load, places)), None)
        return self._near[name]


def end_of_comments(text: str, at: int, indent: str) -> int:
    """The end of the comments after the last statement of a block.

    `at` is in the last line of the statement, `indent` is that of the block. Comments that are
    indented like the block, or more, belong to it; those at the margin do not.
    """
    end = position = at + len(_LINE_END.split(text[at:], maxsplit=1)[0])
    while found := _LINE_END.match(text, position):
        line = _LINE_END.split(text[found.end() :], maxsplit=1)[0]
        position = found.end() + len(line)
        if line.strip() and not (line.startswith(indent) and line.lstrip().startswith("#")):
            break
        end = position if line.strip() else end
    return end


def read_bytes(path: Path) -> bytes | None:
    """The content of a file; None if there is none. Raises `UnreadableSource`."""
    try:
        if not path.is_file():
            return None
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except PermissionError as error:
        if path.parent.exists():
            raise UnreadableSource(f"the file cannot be read: {error.strerror}") from None
        return None
    except OSError:  # an inaccessible folder: the writer reports it
        return None
    if len(data) > MAX_BYTES:
        raise UnreadableSource("it is larger than 4 MB")
    return data


def decode_module(data: bytes) -> tuple[str, str]:
    """Its encoding, declared or not (PEP 263), and its text."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
        return encoding, data.decode(encoding)
    except (SyntaxError, UnicodeDecodeError, LookupError) as error:
        raise UnreadableSource(f"it is not a text: {error}") from None


def _load(path: Path) -> PythonModule | None:
    """The module at `path`; None if there is no file, or Python cannot parse it."""
    try:
        data = read_bytes(path)
        if data is None:
            return None
        encoding, text = decode_module(data)
        return PythonModule(Source(path, text), data, encoding, ast.parse(text))
    except (UnreadableSource, SyntaxError, ValueError, RecursionError, MemoryError):
        return None
