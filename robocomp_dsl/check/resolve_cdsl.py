"""From the tree of a CDSL file to its component.

In: the tree and a workspace. Out: a `Component` with every port that could be understood; the
findings of this file, and the errors of the files that it names.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.interface_names import find_interface
from robocomp_dsl.check.literals import Misfit, as_int
from robocomp_dsl.check.loaded import errors_behind
from robocomp_dsl.check.middlewares import mark_of, middleware_of
from robocomp_dsl.check.named_files import parameters_of, state_machine_of
from robocomp_dsl.check.options import expand
from robocomp_dsl.check.ports import port_names
from robocomp_dsl.check.visible import Visible
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.record import Record
from robocomp_dsl.syntax import ast_cdsl as ast
from robocomp_dsl.syntax.ast_base import Number

DEFAULT_PERIOD = 100
"""Milliseconds; RoboComp's."""
_LONGEST_PERIOD = 24 * 60 * 60 * 1000
_MOST_THREADS = 1024


class Resolved(Record):
    """A component, and for the rules: from written ports to ports."""

    component: Component
    pairs: list[tuple[ast.Port, Port]]


def resolve_cdsl(
    file: Parsed[ast.File], tree: ast.Component, workspace: Workspace, report: Report
) -> Resolved:
    """The component `tree` of a file."""
    expanded = expand(file.tree, tree, report)
    links = workspace.library.links(expanded.imports, report)
    report.extend(errors_behind(links))
    visible = workspace.library.visible(file, links)
    pairs = _ports(expanded.ports, visible, workspace, report)
    component = Component(
        name=tree.name.text,
        path=file.source.path,
        span=tree.name.span,
        language=tree.language.text if tree.language else "Python",
        language_span=tree.language.span if tree.language else None,
        modules=visible.direct,
        ports=tuple(port for _, port in pairs),
        parameters=parameters_of(tree.parameters, file.source.path, workspace, report),
        statemachine=state_machine_of(tree.statemachine, file.source.path, workspace, report),
        middleware=middleware_of(tree.middleware, workspace.middlewares, report),
        period=_whole(tree.period, "period", report, 0, _LONGEST_PERIOD, default=DEFAULT_PERIOD),
        threads=_whole(tree.threads, "threads", report, 1, _MOST_THREADS, default=1),
        gui=tree.gui.widget.text if tree.gui else "",
        options=tuple(one.text for one in tree.options),
        doc=tree.doc,
    )
    return Resolved(component, pairs)


def _ports(
    trees: Sequence[ast.Port], visible: Visible, workspace: Workspace, report: Report
) -> list[tuple[ast.Port, Port]]:
    names = port_names(trees, report)
    found = []
    for tree in trees:
        interface = find_interface(tree.interface, visible, report)
        name = names.get(id(tree))
        middleware = mark_of(tree.middleware, workspace.middlewares, report)
        if interface is not None and name is not None:
            span = tree.alias.span if tree.alias else tree.interface.span
            role, optional = Role(tree.role), tree.optional is not None
            found.append((tree, Port(role, interface, name, span, middleware, optional)))
    return found


def _whole(
    written: Number | None, what: str, report: Report, low: int, high: int, *, default: int
) -> int:
    """A whole number of a component, or its default."""
    if written is None:
        return default
    try:
        value = as_int(written)
    except Misfit as wrong:
        report.add(codes.COMPONENT_NUMBER, written.span, f"`{what}` needs another value: {wrong}")
        return default
    if low <= value <= high:
        return value
    report.add(codes.COMPONENT_NUMBER, written.span, f"`{what}` is {low} to {high}, not {value}")
    return default
