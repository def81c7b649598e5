"""The user's `specificworker.py` as it is: its text, its class, the methods in it.

In: a path. Out: a `UserModule`, or findings that say why there is none. The file is only read.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

from robocomp_dsl.diagnostics import Diagnostic, Report, nearest
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.upkeep.hierarchy import CLASS, Hierarchy, hierarchy, statements
from robocomp_dsl.record import Record, Value
from robocomp_dsl.source import MAX_BYTES, Source, Span, UnreadableSource

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef
"""What `def` makes."""

_LINE_END = re.compile(r"\r\n?|\n")
"""What ends a line for Python."""

_KEYWORDS = re.compile(r"(?:async[\s\\]+)?(?:def|class)[\s\\]+")
"""What stands before the name of a function or a class."""


class UserModule(Record):
    """A module that Python can read."""

    source: Source
    data: bytes
    encoding: str
    tree: ast.Module
    __slots__ = ("__dict__",)  # for what is looked up once

    @cached_property
    def _near(self) -> dict[str, UserModule | None]:
        return {}

    @cached_property
    def starts(self) -> list[int]:
        """Offset of the first character of every line, as Python counts lines."""
        return [0, *(m.end() for m in _LINE_END.finditer(self.source.text))]

    def offset(self, line: int, column: int) -> int:
        """Where in the text: `line` from 1, `column` in bytes of UTF-8 from 0, as `ast` counts."""
        start = self.starts[line - 1]
        # A character has at least one byte, so no more characters than bytes need be looked at.
        ahead = self.source.text[start : start + column].encode("utf-8", "surrogatepass")
        return start + len(ahead[:column].decode("utf-8", "replace"))

    def span_of(self, node: ast.ClassDef | Function) -> Span:
        """The name of a class or function; the tree gives only where its statement begins."""
        start = self.offset(node.lineno, node.col_offset)
        found = _KEYWORDS.match(self.source.text, start)
        at = found.end() if found else start
        return self.source.span(at, at + len(node.name))

    @cached_property
    def hierarchy(self) -> Hierarchy:
        """The class and its bases, as far as they are in this folder."""
        return hierarchy(self)

    @cached_property
    def worker(self) -> ast.ClassDef | None:
        """The user's class, whatever it is called, if it stands at the margin of this module."""
        module, one = self.hierarchy.classes[0] if self.hierarchy.classes else (None, None)
        return one if module is self and one in self.tree.body else None

    @cached_property
    def members(self) -> dict[str, Member | None]:
        """Names in the class and its bases; None for what is no plain `def`."""
        found: dict[str, Member | None] = {}
        for module, one in reversed(self.hierarchy.classes):
            for statement in statements(one.body):
                plain = isinstance(statement, Function) and statement in one.body
                member = Member(module, statement) if plain else None  # type: ignore[arg-type]
                found |= dict.fromkeys(_defined(statement), member)
        return found

    def beside(self, name: str) -> UserModule | None:
        """The module of this dotted name in the same folder, if Python can read it."""
        if name not in self._near:
            path = self.source.path.parent.joinpath(*name.split("."))
            places = (path.with_name(f"{path.name}.py"), path / "__init__.py")
            self._near[name] = next(filter(None, map(_quietly, places)), None)
        return self._near[name]


class Member(Value):
    """A method, and the module that it stands in."""

    module: UserModule
    function: Function

    @property
    def span(self) -> Span:
        """Where its name is."""
        return self.module.span_of(self.function)


def read(path: Path, report: Report) -> UserModule | None:
    """The module at `path`; None if there is no file, or Python cannot read it (told).

    Raises `UnreadableSource` for what is no text.
    """
    data = _bytes(path)
    if data is None:
        return None
    encoding, text = _decoded(data)
    source = Source(path, text)
    try:
        user = parsed(source, data, encoding)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        _report_unreadable(source, error, report)
        return None
    if CLASS not in bound(user.tree):
        _report_no_class(source, user.tree, report)
    return user


def parsed(source: Source, data: bytes = b"", encoding: str = "utf-8") -> UserModule:
    """The module of a text. Raises what Python's parser raises."""
    return UserModule(source, data, encoding, ast.parse(source.text))


def bound(tree: ast.Module) -> set[str]:
    """All names that the module makes, at any depth."""
    return {
        name for node in ast.walk(tree) if isinstance(node, ast.stmt) for name in _defined(node)
    }


def unreadable(path: Path, error: UnreadableSource) -> list[Diagnostic]:
    """The finding about a user's module that is no text."""
    report = Report()
    said = f"`{path.name}` could not be examined: {error}"
    report.add(codes.UNREADABLE_WORKER, Source(path, "").whole, said)
    return list(report)


def _bytes(path: Path) -> bytes | None:
    try:
        if not path.is_file():
            return None
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except PermissionError as error:
        if path.parent.exists():
            raise UnreadableSource(f"the file cannot be read: {error.strerror}") from None
        return None
    except OSError:  # a folder that cannot be entered: the writer says why
        return None
    if len(data) > MAX_BYTES:
        raise UnreadableSource("it is larger than 4 MB")
    return data


def _decoded(data: bytes) -> tuple[str, str]:
    """Its encoding, declared or not (PEP 263), and its text."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
        return encoding, data.decode(encoding)
    except (SyntaxError, UnicodeDecodeError, LookupError) as error:
        raise UnreadableSource(f"it is not a text: {error}") from None


def _quietly(path: Path) -> UserModule | None:
    """A module that is only looked into."""
    try:
        return read(path, Report())
    except UnreadableSource:
        return None


def _defined(statement: ast.stmt) -> Iterator[str]:
    """The names that one statement of a class or a module makes."""
    if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        yield statement.name
    elif isinstance(statement, ast.Import | ast.ImportFrom):
        yield from (alias.asname or alias.name for alias in statement.names)
    else:
        stored = (n for n in ast.walk(statement) if isinstance(n, ast.Name))
        yield from (n.id for n in stored if isinstance(n.ctx, ast.Store))


def _report_no_class(source: Source, tree: ast.Module, report: Report) -> None:
    guess = nearest(CLASS, (c.name for c in tree.body if isinstance(c, ast.ClassDef)))
    label = f"did you mean `{guess}`?" if guess else ""
    said = f"`{source.path.name}` has no class `{CLASS}`"
    report.add(codes.NO_WORKER, source.whole, said, label=label)


def _report_unreadable(source: Source, error: BaseException, report: Report) -> None:
    where = source.whole
    if isinstance(error, SyntaxError) and error.lineno and error.lineno <= len(source.line_starts):
        start = source.line_starts[error.lineno - 1]
        column = min(max((error.offset or 1) - 1, 0), len(source.line(error.lineno)))
        where = source.span(start + column, start + column)
    said = getattr(error, "msg", None) or str(error) or type(error).__name__
    report.add(
        codes.UNREADABLE_WORKER,
        where,
        f"Python cannot read `{source.path.name}`: {said}",
        help="it stays as it is; which operations it lacks is told when it is mended",
    )
