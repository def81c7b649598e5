"""The user's `specificworker.py` as it is: its text, its class, the methods in it.

In: a path. Out: a `UserModule`, or findings that say why there is none. The file is only read.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Report, nearest
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.regeneration.hierarchy import CLASS, Hierarchy, hierarchy, statements
from robocomp_dsl.generate.regeneration.python_module import (
    Function,
    PythonModule,
    decode_module,
    read_bytes,
)
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Source, Span, UnreadableSource


class UserModule(PythonModule):
    """The module of the user's class `SpecificWorker`."""

    __slots__ = ()

    @cached_property
    def hierarchy(self) -> Hierarchy:
        """The class and its bases, as far as they are in this folder."""
        return hierarchy(self)

    @cached_property
    def worker(self) -> ast.ClassDef | None:
        """The user's class, whatever it is called, if it stands at the margin of this module."""
        module, class_ = self.hierarchy.classes[0] if self.hierarchy.classes else (None, None)
        return class_ if module is self and class_ in self.tree.body else None

    @cached_property
    def members(self) -> dict[str, UserMethod | None]:
        """Names in the class and its bases; None for what is no plain `def`."""
        found: dict[str, UserMethod | None] = {}
        for module, class_ in reversed(self.hierarchy.classes):
            for statement in statements(class_.body):
                plain = isinstance(statement, Function) and statement in class_.body
                member = UserMethod(module, statement) if plain else None  # type: ignore[arg-type]
                found |= dict.fromkeys(_defined(statement), member)
        return found


class UserMethod(ValueRecord):
    """A method, and the module that it stands in."""

    module: PythonModule
    function: Function

    @property
    def span(self) -> Span:
        """Where its name is."""
        return self.module.span_of(self.function)


def read(path: Path, report: Report) -> UserModule | None:
    """The module at `path`; None if there is no file, or Python cannot read it (told).

    Raises `UnreadableSource` for what is no text.
    """
    data = read_bytes(path)
    if data is None:
        return None
    encoding, text = decode_module(data)
    source = Source(path, text)
    try:
        user = parsed(source, data, encoding)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        _report_unreadable(source, error, report)
        return None
    if CLASS not in bound_names(user.tree):
        _report_no_class(source, user.tree, report)
    return user


def parsed(source: Source, data: bytes = b"", encoding: str = "utf-8") -> UserModule:
    """The module of a text. Raises what Python's parser raises."""
    return UserModule(source, data, encoding, ast.parse(source.text))


def bound_names(tree: ast.Module) -> set[str]:
    """All names that the module makes, at any depth."""
    return {
        name for node in ast.walk(tree) if isinstance(node, ast.stmt) for name in _defined(node)
    }


def unreadable(path: Path, error: UnreadableSource) -> list[Diagnostic]:
    """The finding about a user's module that is no text."""
    report = Report()
    message = f"`{path.name}` could not be parsed: {error}"
    report.add(codes.UNREADABLE_WORKER, Source(path, "").file_span, message)
    return list(report)


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
    message = f"`{source.path.name}` has no class `{CLASS}`"
    report.add(codes.NO_WORKER, source.file_span, message, label=label)


def _report_unreadable(source: Source, error: BaseException, report: Report) -> None:
    where = source.file_span
    if isinstance(error, SyntaxError) and error.lineno and error.lineno <= len(source.line_starts):
        start = source.line_starts[error.lineno - 1]
        column = min(max((error.offset or 1) - 1, 0), len(source.line(error.lineno)))
        where = source.span(start + column, start + column)
    reason = getattr(error, "msg", None) or str(error) or type(error).__name__
    report.add(
        codes.UNREADABLE_WORKER,
        where,
        f"Python cannot read `{source.path.name}`: {reason}",
        help="fix the syntax error and run rcgen again; rcgen does not change the file",
    )
