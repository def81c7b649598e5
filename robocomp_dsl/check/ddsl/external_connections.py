"""Resolves connections between external programs: `connect yarp "/camera:o" -> "/view:i";`.

In: the tree nodes. Out: the valid connections, and diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from robocomp_dsl.check.cdsl.middlewares import find_middleware
from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import ExternalConnection
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Text

_CARRIER = re.compile(r"[^\s\"/;]+")


def resolve_external_connections(
    trees: Iterable[ast.ExternalConnection], known: KnownMiddlewares, report: Report
) -> tuple[ExternalConnection, ...]:
    """The valid connections, each once."""
    resolved: dict[tuple[str, str, str], ExternalConnection] = {}
    for tree in trees:
        connection = _resolve(tree, known, report)
        if connection is None:
            continue
        key = (connection.middleware, connection.source, connection.target)
        if (first := resolved.setdefault(key, connection)) is not connection:
            report.add(
                codes.EXTERNAL_CONNECTION,
                tree.span,
                f"`{connection.source}` is connected to `{connection.target}` twice",
                notes=(Note(first.span, "already connected here"),),
                help="remove one of the two lines",
            )
    return tuple(resolved.values())


def _resolve(
    tree: ast.ExternalConnection, known: KnownMiddlewares, report: Report
) -> ExternalConnection | None:
    middleware = find_middleware(tree.middleware, known, report)
    description = known.describe(middleware) if middleware else None
    if description is None:
        return None
    pattern = description.capabilities.external_port_names
    if not pattern:
        able = [name for name in known.names() if _connects_programs(name, known)]
        report.add(
            codes.UNSUITABLE_MIDDLEWARE,
            tree.middleware.span,
            f"`{middleware}` cannot connect two programs that are no components",
            help=f"{join_names(able)} can" if able else "",
        )
        return None
    valid = [_is_port(end, pattern, middleware, report) for end in (tree.source, tree.target)]
    carrier = _carrier(tree.carrier, report)
    if not all(valid) or carrier is None:
        return None
    return ExternalConnection(middleware, tree.source.value, tree.target.value, carrier, tree.span)


def _connects_programs(name: str, known: KnownMiddlewares) -> bool:
    description = known.describe(name)
    return description is not None and bool(description.capabilities.external_port_names)


def _is_port(end: Text, pattern: str, middleware: str, report: Report) -> bool:
    if re.fullmatch(pattern, end.value):
        return True
    report.add(
        codes.EXTERNAL_CONNECTION,
        end.span,
        f'"{end.value:.60}" is not the name of a port over `{middleware}`',
        help=_port_example(end.value, pattern),
    )
    return False


def _port_example(written: str, pattern: str) -> str:
    """A similar name that is valid, as advice."""
    guess = "/" + "".join(written.split()).strip("/")
    return f'write "{guess}"' if re.fullmatch(pattern, guess) else "for example `/camera:o`"


def _carrier(written: Name | Text | None, report: Report) -> str | None:
    if written is None:
        return ""
    text = written.text if isinstance(written, Name) else written.value
    if _CARRIER.fullmatch(text):
        return text
    report.add(
        codes.EXTERNAL_CONNECTION,
        written.span,
        f'"{text:.60}" is not a carrier',
        help="a carrier is one word, such as `tcp` or `fast_tcp`",
    )
    return None
