"""The scopes of a deployment: name lookup in groups and their exports.

In: the tree of a deployment. Out: scopes, one for the deployment and one per group, and diagnostics
about unknown names. A name is looked up in its scope, then in the enclosing groups, then in the
deployment. The components of a group are visible outside only through its exports.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import report_duplicate, unique_by_name
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name

NAME_SEPARATOR = "-"
"""Separates the names of a group and its members; identifiers cannot contain it."""


@dataclass(slots=True, eq=False)
class DeploymentScope:
    """A group, or the deployment itself (`path` ""), with what is declared in it.

    Only the deployment has `externals`.
    """

    path: str
    tree: ast.Deployment | ast.Group
    outer: DeploymentScope | None
    instances: dict[str, ast.Instance] = field(default_factory=dict)
    groups: dict[str, DeploymentScope] = field(default_factory=dict)
    exports: dict[str, ast.Export] = field(default_factory=dict)
    externals: dict[str, ast.External] = field(default_factory=dict)

    @property
    def ancestors(self) -> Iterator[DeploymentScope]:
        """The scope and its enclosing scopes, innermost first."""
        nested: DeploymentScope | None = self
        while nested is not None:
            yield nested
            nested = nested.outer

    @property
    def descendants(self) -> Iterator[DeploymentScope]:
        """The scope and its nested scopes, outer scopes first."""
        yield self
        for nested in self.groups.values():
            yield from nested.descendants

    def qualified_name(self, name: str) -> str:
        """The name of an instance of this scope, qualified with its groups."""
        return f"{self.path}{NAME_SEPARATOR}{name}" if self.path else name

    def members(self) -> list[str]:
        """The qualified names of all instances in this scope and its groups."""
        return [
            nested.qualified_name(name) for nested in self.descendants for name in nested.instances
        ]

    def lookup(self, name: str) -> DeploymentScope | str | None:
        """The group, or the qualified name of the instance, called `name` in this scope."""
        for nested in self.ancestors:
            if name in nested.instances:
                return nested.qualified_name(name)
            if name in nested.groups:
                return nested.groups[name]
        return None

    def visible_names(self) -> list[str]:
        """All names that can be used in this scope."""
        return [name for nested in self.ancestors for name in (*nested.instances, *nested.groups)]


def scopes_of(tree: ast.Deployment, report: Report) -> DeploymentScope:
    """The scope of a deployment, with all its groups."""
    return _filled(DeploymentScope("", tree, None), report)


def _filled(scope: DeploymentScope, report: Report) -> DeploymentScope:
    tree = scope.tree
    for instance in unique_by_name(tree.instances, "component", report):
        scope.instances[instance.name.text] = instance
    for group in unique_by_name(tree.groups, "group", report):
        name = group.name.text
        if name in scope.instances:
            report_duplicate(group.name, scope.instances[name].name, "component", report)
            continue
        inner = DeploymentScope(scope.qualified_name(name), group, scope)
        scope.groups[name] = _filled(inner, report)
    if isinstance(tree, ast.Deployment):
        _externals(scope, tree, report)
    if isinstance(tree, ast.Group):
        _exports(scope, tree, report)
        if not tree.instances and not tree.groups:
            message = f"the group `{tree.name.text}` has no components"
            report.add(codes.EMPTY_DEPLOYMENT, tree.name.span, message)
    return scope


def _externals(scope: DeploymentScope, tree: ast.Deployment, report: Report) -> None:
    for external in unique_by_name(tree.externals, "external program", report):
        name = external.name.text
        if name in scope.instances:
            report_duplicate(external.name, scope.instances[name].name, "component", report)
        elif name in scope.groups:
            report_duplicate(external.name, scope.groups[name].tree.name, "group", report)
        else:
            scope.externals[name] = external


def _exports(scope: DeploymentScope, tree: ast.Group, report: Report) -> None:
    for nested in tree.exports:
        earlier = scope.exports.setdefault(nested.port.text, nested)
        if earlier is not nested:
            report_duplicate(nested.port, earlier.port, "export", report)


def flatten(scope: DeploymentScope) -> list[tuple[ast.Instance, str]]:
    """All instances with their groups, with qualified names as if there were no groups.

    `component` is always set, and `after` lists qualified names, including the dependencies of the
    group.
    """
    resolved: list[tuple[ast.Instance, str]] = []
    for nested in scope.descendants:
        waits = _group_dependencies(nested)
        for tree in nested.instances.values():
            own = [
                name for dependency in tree.after for name in _resolve_reference(dependency, nested)
            ]
            renamed = ast.Instance(
                tree.span,
                Name(tree.name.span, nested.qualified_name(tree.name.text)),
                tree.component or tree.name,
                tree.host,
                tree.config,
                tree.context,
                tree.from_,
                tree.prefix,
                tree.settings,
                tree.devices,
                tree.attachments,
                tree.actions,
                tree.environment,
                tree.executable,
                tree.port,
                (*own, *waits),
                tree.restart,
                tree.ready,
                tree.ready_when,
                tree.memory,
                tree.cpu,
                tree.watchdog,
                tree.middleware,
                tree.own_ports,
                tree.doc,
                tree.is_program,
                tree.label,
                tree.place,
                tree.cores,
                tree.realtime,
                tree.files,
            )
            resolved.append((renamed, nested.path))
    return resolved


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


def resolve_port(ref: ast.PortRef, scope: DeploymentScope, report: Report) -> ast.PortRef | None:
    """Resolve `ref` to a port of an instance, through exports if it refers to a group.

    None if it cannot be resolved, which is reported.
    """
    found = scope.lookup(ref.instance.text)
    if found is None:
        return _resolve_external(ref, scope, report)
    if isinstance(found, str):
        return ast.PortRef(ref.span, Name(ref.instance.span, found), ref.port)
    export = found.exports.get(ref.port.text)
    if export is None:
        _not_exported(ref, found, report)
        return None
    if _is_export_cycle(export, found):
        report.add(
            codes.UNKNOWN_PORT,
            ref.span,
            f"`{ref.port.text}` of `{ref.instance.text}` is exported in a cycle",
            help="export it from the component that has it",
        )
        return None
    inside = resolve_port(export.target, found, Report())  # `check_exports` reports errors there
    if inside is None:
        return None
    port = Name(ref.port.span, inside.port.text)
    return ast.PortRef(ref.span, Name(ref.instance.span, inside.instance.text), port)


def _resolve_external(
    ref: ast.PortRef, scope: DeploymentScope, report: Report
) -> ast.PortRef | None:
    """`ref` if it refers to an external program; else None, which is reported."""
    if ref.instance.text in [*scope.ancestors][-1].externals:
        return ref
    _unknown(ref.instance, scope, report)
    return None


def _is_export_cycle(export: ast.Export, scope: DeploymentScope) -> bool:
    """Whether an export in `scope` refers back to itself through other groups."""
    followed: list[ast.Export] = []
    following: ast.Export | None = export
    while following is not None:
        if any(nested is following for nested in followed):
            return True
        followed.append(following)
        target = following.target
        found = scope.lookup(target.instance.text)
        if not isinstance(found, DeploymentScope):
            return False
        following, scope = found.exports.get(target.port.text), found
    return False


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


def _unknown(name: Name, scope: DeploymentScope, report: Report) -> None:
    root = [*scope.ancestors][-1]
    known = [*scope.visible_names(), *root.externals]
    guess = nearest(name.text, known)
    hidden = next(
        (
            nested.path
            for nested in root.descendants
            if nested.path and name.text in nested.instances
        ),
        "",
    )
    inside = f"it is in the group `{hidden}`; only its exports are visible here"
    report.add(
        codes.UNKNOWN_INSTANCE,
        name.span,
        f"there is no component `{name.text}` "
        + ("in this deployment" if not hidden else "that is visible here"),
        label=f"did you mean `{guess}`?" if guess else "",
        help=inside if hidden else "" if guess else f"it has {join_names(known)}",
        fix=replace_fix(name.span, guess) if guess and not hidden else None,
    )


def _not_exported(ref: ast.PortRef, group: DeploymentScope, report: Report) -> None:
    known = list(group.exports)
    guess = nearest(ref.port.text, known)
    name = ref.instance.text
    report.add(
        codes.UNKNOWN_PORT,
        ref.port.span,
        f"the group `{name}` does not export `{ref.port.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(group.tree.name.span, f"`{name}` is declared here")],
        help=f"write `export {ref.port.text} from …;` in it"
        if not known
        else f"it exports {join_names(known)}",
        fix=replace_fix(ref.port.span, guess) if guess else None,
    )


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
            guess = nearest(name.text, known)
            report.add(
                codes.UNKNOWN_INSTANCE,
                name.span,
                f"there is no component `{name.text}` in the group `{nested.tree.name.text}`",
                label=f"did you mean `{guess}`?" if guess else "",
                help="" if guess else f"it has {join_names(known) or 'none'}",
                fix=replace_fix(name.span, guess) if guess else None,
            )
