"""Resolves the groups of a deployment.

In: scopes and the resolved instances. Out: `Group` values, the exports visible in each scope, and
diagnostics about unknown exported ports.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.one_process import with_process
from robocomp_dsl.check.ddsl.scopes import DeploymentScope, resolve_port
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import Export, Group, Instance
from robocomp_dsl.syntax.ast import ddsl as ast


def resolve_groups(
    scope: DeploymentScope, known: Mapping[str, Instance], report: Report
) -> tuple[Group, ...]:
    """All groups, outer groups first."""
    return tuple(
        with_process(
            _group(inner, known, report),
            inner,
            [known[name] for name in inner.members() if name in known],
            report,
        )
        for inner in scope.descendants
        if inner.path
    )


def _group(scope: DeploymentScope, known: Mapping[str, Instance], report: Report) -> Group:
    definition = scope.tree.definition if isinstance(scope.tree, ast.Group) else None
    return Group(
        scope.path,
        tuple(scope.members()),
        _exports(scope, known, report),
        scope.tree.name.span,
        scope.tree.doc,
        definition.text if definition else "",
        scope.full_prefix,
    )


def _exports(
    scope: DeploymentScope, known: Mapping[str, Instance], report: Report
) -> tuple[Export, ...]:
    exports = []
    for name, tree in scope.exports.items():
        target = resolve_port(tree.target, scope, Report())
        instance = known.get(target.instance.text) if target else None
        if target is None or instance is None:
            continue
        port = _port(target.port.text, tree, instance, report)
        if port is not None:
            exports.append(Export(name, instance, port, tree.port.span))
    return tuple(exports)


def check_exports(scope: DeploymentScope, report: Report) -> None:
    """Report exports of components that are not in the group."""
    for nested in scope.descendants:
        for export in nested.exports.values():
            name = export.target.instance
            if name.text in nested.instances:
                continue
            if name.text in nested.groups:
                resolve_port(export.target, nested, report)
                continue
            known = [*nested.instances, *nested.groups]
            report_unknown_name(
                report,
                codes.UNKNOWN_INSTANCE,
                name,
                f"there is no component `{name.text}` in the group `{nested.tree.name.text}`",
                known,
                f"it has {join_names(known) or 'none'}",
                declared=nested.own_declarations(),
            )


def _port(name: str, tree: ast.Export, instance: Instance, report: Report) -> Port | None:
    known = {inner.name: inner for inner in instance.component.ports}
    if name in known:
        return known[name]
    if name in instance.component.invalid_ports:
        return None
    guess = nearest(name, known)
    report.add(
        codes.UNKNOWN_PORT,
        tree.target.port.span,
        f"`{instance.name}` has no port `{name}`",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(instance.component.span, f"`{instance.component.name}` is declared here")],
        help="" if guess else f"it has {join_names(list(known)) or 'none'}",
        fix=replace_fix(tree.target.port.span, guess) if guess else None,
    )
    return None


def visible_exports(scope: DeploymentScope) -> dict[str, dict[tuple[str, str], str]]:
    """By scope: the ports that its groups export, and how they are written there.

    A port is a pair of the full name of its instance and its own name.
    """
    by_scope: dict[str, dict[tuple[str, str], str]] = {}
    for inner in scope.descendants:
        exported = by_scope.setdefault(inner.path, {})
        for name, group in inner.groups.items():
            for alias, export in group.exports.items():
                target = resolve_port(export.target, group, Report())
                if target:
                    exported.setdefault((target.instance.text, target.port.text), f"{name}.{alias}")
    return by_scope
