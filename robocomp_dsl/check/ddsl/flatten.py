"""Flattens the groups of a deployment: instances and connections as if there were none.

In: scopes. Out: the trees of all instances, connections and arbitrations with qualified names.
"""

from __future__ import annotations

from robocomp_dsl.check.ddsl.scopes import (
    DeploymentScope,
    resolve_port,
)
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Text


def flatten(scope: DeploymentScope) -> list[tuple[ast.Instance, str]]:
    """All instances with their groups, with qualified names as if there were no groups.

    `component` is always set, `prefix` contains those of the groups, and `after` lists qualified
    names, including the dependencies of the group.
    """
    resolved: list[tuple[ast.Instance, str]] = []
    for nested in scope.descendants:
        waits = _group_dependencies(nested)
        for tree in nested.instances.values():
            own = [
                name for dependency in tree.after for name in _resolve_reference(dependency, nested)
            ]
            renamed = tree.replace(
                name=Name(tree.name.span, nested.qualified_name(tree.name.text)),
                component=tree.component or tree.name,
                prefix=_full_prefix(tree.prefix, nested),
                after=(*own, *waits),
            )
            resolved.append((renamed, nested.path))
    return resolved


def _full_prefix(own: Name | Text | None, scope: DeploymentScope) -> Name | Text | None:
    """The prefix of an instance below those of its groups."""
    outer = scope.full_prefix
    if not outer:
        return own
    text = "" if own is None else own.text if isinstance(own, Name) else own.value
    span = scope.tree.name.span if own is None else own.span
    return Text(span, "/".join(filter(None, (outer, text.strip("/")))))


def _group_dependencies(scope: DeploymentScope) -> list[Name]:
    """The dependencies of the enclosing groups, which apply to all their components."""
    return [
        name
        for nested in scope.ancestors
        if isinstance(nested.tree, ast.Group) and nested.outer is not None
        for dependency in nested.tree.after
        for name in _resolve_reference(dependency, nested.outer)
    ]


def _resolve_reference(dependency: Name, scope: DeploymentScope) -> list[Name]:
    found = scope.lookup(dependency.text)
    if isinstance(found, DeploymentScope):
        return [Name(dependency.span, nested) for nested in found.members()]
    return [] if found is None else [Name(dependency.span, found)]


def connections_of(scope: DeploymentScope, report: Report) -> tuple[list[ast.Connection], set[str]]:
    """All connections with qualified names, and the names of instances with an invalid one."""
    resolved: list[ast.Connection] = []
    faulty: set[str] = set()
    for nested in scope.descendants:
        for tree in nested.tree.connections:
            ends = [resolve_port(end, nested, report) for end in (tree.source, tree.target)]
            source, target = ends
            if source is None or target is None:
                faulty.update(end.instance.text for end in ends if end)
            else:
                resolved.append(
                    ast.Connection(tree.span, source, target, tree.over, tree.qos, tree.monitors)
                )
    return resolved, faulty


def arbitrations_of(scope: DeploymentScope, report: Report) -> list[ast.Arbitration]:
    """All arbitrations with qualified names."""
    resolved: list[ast.Arbitration] = []
    for nested in scope.descendants:
        for tree in nested.tree.arbitrations:
            target = resolve_port(tree.target, nested, report)
            sources = [(resolve_port(c.source, nested, report), c) for c in tree.candidates]
            if target is not None:
                candidates = tuple(
                    ast.Candidate(candidate.span, source, candidate.condition)
                    for source, candidate in sources
                    if source is not None
                )
                resolved.append(ast.Arbitration(tree.span, target, candidates))
    return resolved
