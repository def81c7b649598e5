"""The groups of a deployment, resolved.

In: scopes and the instances that are known. Out: `Group` values, what is seen from where, and
findings about exported ports that are not there.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.scopes import Scope, port_of
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import Export, Group, Instance
from robocomp_dsl.syntax import ast_ddsl as ast


def groups_of(scope: Scope, known: Mapping[str, Instance], report: Report) -> tuple[Group, ...]:
    """All groups, outer ones first."""
    return tuple(
        Group(
            one.path,
            tuple(one.members()),
            _exports(one, known, report),
            one.tree.name.span,
            one.tree.doc,
        )
        for one in scope.all
        if one.path
    )


def _exports(scope: Scope, known: Mapping[str, Instance], report: Report) -> tuple[Export, ...]:
    made = []
    for name, tree in scope.exports.items():
        target = port_of(tree.target, scope, Report())
        instance = known.get(target.instance.text) if target else None
        if target is None or instance is None:
            continue
        port = _port(target.port.text, tree, instance, report)
        if port is not None:
            made.append(Export(name, instance, port, tree.port.span))
    return tuple(made)


def _port(name: str, tree: ast.Export, instance: Instance, report: Report) -> Port | None:
    known = {one.name: one for one in instance.component.ports}
    if name in known:
        return known[name]
    guess = nearest(name, known)
    report.add(
        codes.UNKNOWN_PORT,
        tree.target.port.span,
        f"`{instance.name}` has no port `{name}`",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(instance.component.span, f"`{instance.component.name}` is declared here")],
        help="" if guess else f"it has {listing(list(known)) or 'none'}",
        fix=replace(tree.target.port.span, guess) if guess else None,
    )
    return None


def seen(scope: Scope) -> dict[str, dict[tuple[str, str], str]]:
    """By scope: the ports in its groups that are exported to it, and how they are written there.

    A port is the full name of its instance and its own.
    """
    made: dict[str, dict[tuple[str, str], str]] = {}
    for one in scope.all:
        found = made.setdefault(one.path, {})
        for name, group in one.groups.items():
            for alias, export in group.exports.items():
                target = port_of(export.target, group, Report())
                if target:
                    found.setdefault((target.instance.text, target.port.text), f"{name}.{alias}")
    return made
