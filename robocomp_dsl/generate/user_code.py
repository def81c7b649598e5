"""The user's class compared with the component: which operations it has no method for.

In: the text of `specificworker.py` and the component. Out: findings; the file itself is only read.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Note, Report, nearest
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.component_names import names_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Source, Span, UnreadableSource

CLASS = "SpecificWorker"
BASE = "GenericWorker"


def judge_user_code(source: Source, component: Component) -> list[Diagnostic]:
    """What `source`, the user's module, lacks."""
    report = Report()
    try:
        tree = ast.parse(source.text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        _report_unreadable(source, error, report)
        return list(report)
    classes = {c.name: c for c in tree.body if isinstance(c, ast.ClassDef)}
    worker = classes.get(CLASS)
    if worker is not None:
        _judge_class(worker, classes, source, component, report)
    elif CLASS not in _bound(tree):
        guess = nearest(CLASS, classes)
        label = f"did you mean `{guess}`?" if guess else ""
        said = f"`{source.path.name}` has no class `{CLASS}`"
        report.add(codes.NO_WORKER, source.whole, said, label=label)
    return list(report)


def unreadable(path: Path, error: UnreadableSource) -> list[Diagnostic]:
    """The finding about a user's module that is no text."""
    report = Report()
    said = f"`{path.name}` could not be examined: {error}"
    report.add(codes.UNREADABLE_WORKER, Source(path, "").whole, said)
    return list(report)


def _judge_class(
    worker: ast.ClassDef,
    classes: dict[str, ast.ClassDef],
    source: Source,
    component: Component,
    report: Report,
) -> None:
    known = _members(worker, classes, set())
    if known is None:
        return
    where = _name_span(source, worker)
    for (port, operation), method in names_of(component).handlers.items():
        if method not in known:
            guess = nearest(method, (k for k in known if k.startswith(f"{port.name}_")))
            report.add(
                codes.MISSING_METHOD,
                where,
                f"`{CLASS}` has no method `{method}`",
                label=f"did you mean `{guess}`?" if guess else "",
                notes=[Note(operation.span, f"`{port.interface.qualified}` has this operation")],
                help=f"`{BASE}` in generated/genericworker.py has its signature",
            )


def _members(
    one: ast.ClassDef, classes: dict[str, ast.ClassDef], seen: set[str]
) -> set[str] | None:
    """Names that a class has, those of bases in the same file too; None if it has other bases."""
    seen.add(one.name)
    found = {name for statement in one.body for name in _defined(statement)}
    for base in one.bases:
        name = base.id if isinstance(base, ast.Name) else getattr(base, "attr", "")
        if name == BASE or name in seen:
            continue
        inherited = _members(classes[name], classes, seen) if name in classes else None
        if inherited is None:
            return None
        found |= inherited
    return found


def _defined(statement: ast.stmt) -> Iterator[str]:
    """The names that one statement of a class or a module makes."""
    if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        yield statement.name
    elif isinstance(statement, ast.Import | ast.ImportFrom):
        yield from (alias.asname or alias.name for alias in statement.names)
    else:
        stored = (n for n in ast.walk(statement) if isinstance(n, ast.Name))
        yield from (n.id for n in stored if isinstance(n.ctx, ast.Store))


def _bound(tree: ast.Module) -> set[str]:
    return {
        name for node in ast.walk(tree) if isinstance(node, ast.stmt) for name in _defined(node)
    }


def _name_span(source: Source, worker: ast.ClassDef) -> Span:
    """The name of the class; the tree gives only where the statement begins."""
    start = source.line_starts[worker.lineno - 1]
    at = source.text.find(worker.name, start)
    return source.span(at, at + len(worker.name))


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
