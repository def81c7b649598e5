"""The scopes of a deployment: name lookup in groups and their exports.

In: the tree of a deployment. Out: scopes, one for the deployment and one per group, and diagnostics
about unknown names. A name is looked up in its scope, then in the enclosing groups, then in the
deployment. The components of a group are visible outside only through its exports.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.definitions import DefinitionFiles
from robocomp_dsl.check.ddsl.expansion import expand, settings_of_members, with_settings
from robocomp_dsl.check.ddsl.prefixes import prefix_of
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import report_duplicate, unique_by_name
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name

NAME_SEPARATOR = "-"
"""Separates the names of a group and its members; identifiers cannot contain it."""


@dataclass(slots=True, eq=False)
class DeploymentScope:
    """A group, or the deployment itself (`path` ""), with what is declared in it.

    Only the deployment has `externals`. `tree` is the expanded tree of a group. `definitions` are
    those that an instance follows; names of its surroundings are not visible in it. `prefix` is
    its own.
    """

    path: str
    tree: ast.Deployment | ast.Group
    outer: DeploymentScope | None
    definitions: tuple[ast.Group, ...] = ()
    prefix: str = ""
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
    def visible_scopes(self) -> Iterator[DeploymentScope]:
        """The scopes whose names can be used in this one, innermost first."""
        for nested in self.ancestors:
            yield nested
            if nested.definitions:
                return

    @property
    def full_prefix(self) -> str:
        """The prefixes of the scope and its enclosing scopes, joined."""
        return "/".join(reversed([scope.prefix for scope in self.ancestors if scope.prefix]))

    @property
    def is_unknown(self) -> bool:
        """Whether it is an instance without a definition, which was reported."""
        return isinstance(self.tree, ast.Group) and bool(self.tree.definition) > bool(
            self.definitions
        )

    @property
    def has_unknown_groups(self) -> bool:
        """Whether an instance without a definition is in this scope."""
        return any(nested.is_unknown for nested in self.descendants)

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
        for nested in self.visible_scopes:
            if name in nested.instances:
                return nested.qualified_name(name)
            if name in nested.groups:
                return nested.groups[name]
        return None

    def visible_names(self) -> list[str]:
        """All names that can be used in this scope."""
        scopes = self.visible_scopes
        return [name for nested in scopes for name in (*nested.instances, *nested.groups)]

    def own_declarations(self) -> list[Span]:
        """The names in the declarations of this scope."""
        groups = (group.tree for group in self.groups.values())
        trees = (*self.instances.values(), *groups, *self.externals.values())
        return [tree.name.span for tree in trees]


def scopes_of(
    tree: ast.Deployment, definitions: DefinitionFiles, report: Report
) -> DeploymentScope:
    """The scope of a deployment, with all its groups."""
    definitions.begin_deployment()
    return _filled(DeploymentScope("", tree, None), (), (), definitions, report)


def _filled(
    scope: DeploymentScope,
    settings: Sequence[ast.Setting],
    followed: tuple[ast.Group, ...],
    definitions: DefinitionFiles,
    report: Report,
) -> DeploymentScope:
    """Fill a scope; `settings` are those of outer groups, `followed` the definitions around it."""
    tree = scope.tree
    instances = unique_by_name(tree.instances, "component", report)
    groups = unique_by_name(tree.groups, "group", report)
    members = {tree.name.text: tree.name.span for tree in instances}
    members |= {tree.name.text: tree.name.span for tree in groups}
    outer: dict[str, list[ast.Setting]] = {}
    if isinstance(tree, ast.Group):
        outer = settings_of_members(tree, settings, members, report)
    for instance in instances:
        name = instance.name.text
        scope.instances[name] = with_settings(instance, outer.get(name, ()))
    siblings = {group.name.text: group for group in groups if group.definition is None}
    for group in groups:
        name = group.name.text
        if name in scope.instances:
            report_duplicate(group.name, scope.instances[name].name, "component", report)
            continue
        expanded, chain = expand(group, siblings, followed, definitions, report)
        inner = DeploymentScope(
            scope.qualified_name(name),
            expanded,
            scope,
            chain,
            prefix_of(expanded.prefix, report),
        )
        if group.definition is None or chain:
            inherited = outer.get(name, ())
            _filled(inner, inherited, (*followed, *chain), definitions, report)
        scope.groups[name] = inner
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
        if not found.is_unknown:
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
    if ref.instance.text in [*scope.visible_scopes][-1].externals:
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


def _unknown(name: Name, scope: DeploymentScope, report: Report) -> None:
    root = [*scope.visible_scopes][-1]
    known = [*scope.visible_names(), *root.externals]
    hidden = next(
        (
            nested.path
            for nested in root.descendants
            if nested.path and name.text in nested.instances
        ),
        "",
    )
    inside = f"it is in the group `{hidden}`; only its exports are visible here"
    report_unknown_name(
        report,
        codes.UNKNOWN_INSTANCE,
        name,
        f"there is no component `{name.text}` "
        + ("in this deployment" if not hidden else "that is visible here"),
        () if hidden else known,
        inside if hidden else f"it has {join_names(known)}",
        declared=[span for nested in scope.visible_scopes for span in nested.own_declarations()],
    )


def _not_exported(ref: ast.PortRef, group: DeploymentScope, report: Report) -> None:
    known = list(group.exports)
    name = ref.instance.text
    report_unknown_name(
        report,
        codes.UNKNOWN_PORT,
        ref.port,
        f"the group `{name}` does not export `{ref.port.text}`",
        known,
        f"it exports {join_names(known)}"
        if known
        else f"write `export {ref.port.text} from …;` in it",
        declared=[export.port.span for export in group.exports.values()],
        notes=[Note(group.tree.name.span, f"`{name}` is declared here")],
    )
