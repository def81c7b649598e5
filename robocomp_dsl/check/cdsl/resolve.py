"""Resolves the component of a CDSL file.

In: the tree and a workspace. Out: a `Component` with every valid port, the diagnostics of this
file, and the errors of the files that it references.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.cdsl.middlewares import (
    DEFAULT,
    check_roles,
    find_middleware,
    port_middlewares,
)
from robocomp_dsl.check.cdsl.options import expand_options, resolve_imports
from robocomp_dsl.check.cdsl.ports import port_names
from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.doc_comments import plain
from robocomp_dsl.check.literals import TypeMismatch, as_int
from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.names.interface_names import find_interface
from robocomp_dsl.check.watchdog import watchdog_of
from robocomp_dsl.check.workspace.loaded import transitive_errors
from robocomp_dsl.check.workspace.referenced_files import parameters_of, state_machine_of
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.record import Record
from robocomp_dsl.syntax.ast import cdsl as ast
from robocomp_dsl.syntax.ast.base import Number

DEFAULT_PERIOD = 100
"""Milliseconds; RoboComp's."""
_LONGEST_PERIOD = 24 * 60 * 60 * 1000
_MOST_THREADS = 1024


class ResolvedComponent(Record):
    """A component, and pairs of tree port and resolved port for the rules."""

    component: Component
    pairs: list[tuple[ast.Port, Port]]


def resolve_cdsl(
    file: Parsed[ast.File], tree: ast.Component, workspace: Workspace, report: Report
) -> ResolvedComponent:
    """Resolve the component `tree` of a file."""
    expanded = expand_options(file.tree, tree, report)
    links = resolve_imports(expanded, workspace.modules, report)
    report.extend(transitive_errors(links))
    scope = workspace.modules.import_scope(file, links)
    names = port_names(expanded.ports, report)
    pairs = _ports(expanded.ports, names, scope, workspace, report)
    valid = {id(tree) for tree, _ in pairs}
    invalid = (names.get(id(tree)) for tree in expanded.ports if id(tree) not in valid)
    middleware = find_middleware(tree.middleware, workspace.middlewares, report)
    component = Component(
        name=tree.name.text,
        path=file.source.path,
        span=tree.name.span,
        language=tree.language.text if tree.language else "Python",
        language_span=tree.language.span if tree.language else None,
        modules=scope.direct,
        ports=tuple(port for _, port in pairs),
        parameters=parameters_of(tree.parameters, file.source.path, workspace, report),
        statemachine=state_machine_of(tree.statemachine, file.source.path, workspace, report),
        middleware=middleware or DEFAULT,
        middleware_span=tree.middleware.span if tree.middleware and middleware else None,
        period=_whole(tree.period, "period", report, 0, _LONGEST_PERIOD, default=DEFAULT_PERIOD),
        threads=_whole(tree.threads, "threads", report, 1, _MOST_THREADS, default=1),
        watchdog_s=watchdog_of(tree.watchdog, codes.COMPONENT_NUMBER, report) or 0.0,
        gui=tree.gui.widget.text if tree.gui else "",
        options=tuple(option.text for option in tree.options),
        doc=plain(tree.doc),
        invalid_ports=frozenset(name for name in invalid if name),
    )
    check_roles(pairs, component, workspace.middlewares, report)
    return ResolvedComponent(component, pairs)


def _ports(
    trees: Sequence[ast.Port],
    names: dict[int, str],
    scope: ImportScope,
    workspace: Workspace,
    report: Report,
) -> list[tuple[ast.Port, Port]]:
    pairs = []
    for tree in trees:
        interface = find_interface(tree.interface, scope, report)
        name = names.get(id(tree))
        middlewares = port_middlewares(tree.middlewares, workspace.middlewares, report)
        if interface is not None and name is not None:
            span = tree.alias.span if tree.alias else tree.interface.span
            role, optional = Role(tree.role), tree.optional is not None
            pairs.append((tree, Port(role, interface, name, span, middlewares, optional)))
    return pairs


def _whole(
    written: Number | None, what: str, report: Report, low: int, high: int, *, default: int
) -> int:
    """An integer setting of a component, or its default."""
    if written is None:
        return default
    try:
        value = as_int(written)
    except TypeMismatch as wrong:
        report.add(codes.COMPONENT_NUMBER, written.span, f"`{what}` has an invalid value: {wrong}")
        return default
    if low <= value <= high:
        return value
    report.add(
        codes.COMPONENT_NUMBER, written.span, f"`{what}` must be {low} to {high}, not {value}"
    )
    return default
