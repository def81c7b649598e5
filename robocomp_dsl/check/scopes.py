"""The groups of a deployment: what may be named where, and what is seen from outside.

In: the tree of a deployment. Out: scopes, one for the deployment and one per group. A name is
looked up where it is written, then in the groups around, then in the deployment; nobody looks into
a group but through its exports. Findings are about names that are not there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.names import report_repeat, without_repeats
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Name

JOINT = "-"
"""Between the name of a group and those in it; no name that is written has one."""


@dataclass(slots=True, eq=False)
class Scope:
    """A group, or the deployment itself (`path` ""), with what is declared in it."""

    path: str
    tree: ast.Deployment | ast.Group
    outer: Scope | None
    host: Name | None = None
    instances: dict[str, ast.Instance] = field(default_factory=dict)
    groups: dict[str, Scope] = field(default_factory=dict)
    exports: dict[str, ast.Export] = field(default_factory=dict)

    @property
    def around(self) -> Iterator[Scope]:
        """The scope and those that it is in, innermost first."""
        one: Scope | None = self
        while one is not None:
            yield one
            one = one.outer

    @property
    def all(self) -> Iterator[Scope]:
        """The scope and those in it, outer ones first."""
        yield self
        for one in self.groups.values():
            yield from one.all

    def full(self, name: str) -> str:
        """The name of an instance here by which it is known in the whole deployment."""
        return f"{self.path}{JOINT}{name}" if self.path else name

    def members(self) -> list[str]:
        """The full names of all instances here and in the groups here."""
        return [one.full(name) for one in self.all for name in one.instances]

    def find(self, name: str) -> Scope | str | None:
        """A group, or the full name of an instance, that `name` means here."""
        for one in self.around:
            if name in one.instances:
                return one.full(name)
            if name in one.groups:
                return one.groups[name]
        return None

    def visible(self) -> list[str]:
        """Everything that can be named here."""
        return [name for one in self.around for name in (*one.instances, *one.groups)]


def scopes_of(tree: ast.Deployment, report: Report) -> Scope:
    """The scope of a deployment, with all its groups."""
    return _filled(Scope("", tree, None), report)


def _filled(scope: Scope, report: Report) -> Scope:
    tree = scope.tree
    for instance in without_repeats(tree.instances, "component", report):
        scope.instances[instance.name.text] = instance
    for group in without_repeats(tree.groups, "group", report):
        name = group.name.text
        if name in scope.instances:
            report_repeat(group.name, scope.instances[name].name, "component", report)
            continue
        inner = Scope(scope.full(name), group, scope, group.host or scope.host)
        if group.host and scope.host and group.host.text != scope.host.text:
            report_two_places(group.name.text, group.host, scope.host, report)
        scope.groups[name] = _filled(inner, report)
    if isinstance(tree, ast.Group):
        _exports(scope, tree, report)
        if not tree.instances and not tree.groups:
            said = f"the group `{tree.name.text}` has no components"
            report.add(codes.EMPTY_DEPLOYMENT, tree.name.span, said)
    return scope


def _exports(scope: Scope, tree: ast.Group, report: Report) -> None:
    for one in tree.exports:
        earlier = scope.exports.setdefault(one.port.text, one)
        if earlier is not one:
            report_repeat(one.port, earlier.port, "export", report)


def report_two_places(what: str, inner: Name, outer: Name, report: Report) -> None:
    """Report that something would be on two hosts at once."""
    report.add(
        codes.PLACED_TWICE,
        inner.span,
        f"`{what}` is placed twice: on `{inner.text}`, and with its group on `{outer.text}`",
        notes=[Note(outer.span, "its group is placed here")],
        help="leave out one of the two, or take it out of the group",
    )


def flat(scope: Scope, report: Report) -> list[tuple[ast.Instance, str]]:
    """All instances with their groups, as if they were written without: with full names.

    Their component is always named, their host is that of the group where none is written, and
    `after` lists full names, those that the group waits for included.
    """
    made: list[tuple[ast.Instance, str]] = []
    for one in scope.all:
        waits = _waits_of_groups(one)
        for tree in one.instances.values():
            if tree.host and one.host and tree.host.text != one.host.text:
                report_two_places(tree.name.text, tree.host, one.host, report)
            own = [name for wanted in tree.after for name in _meant(wanted, one)]
            renamed = ast.Instance(
                tree.span,
                Name(tree.name.span, one.full(tree.name.text)),
                tree.component or tree.name,
                tree.host or one.host,
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
                tree.doc,
            )
            made.append((renamed, one.path))
    return made


def _waits_of_groups(scope: Scope) -> list[Name]:
    """What the groups around wait for, so that all in them do."""
    return [
        name
        for one in scope.around
        if isinstance(one.tree, ast.Group) and one.outer is not None
        for wanted in one.tree.after
        for name in _meant(wanted, one.outer)
    ]


def _meant(wanted: Name, scope: Scope) -> list[Name]:
    found = scope.find(wanted.text)
    if isinstance(found, Scope):
        return [Name(wanted.span, one) for one in found.members()]
    return [] if found is None else [Name(wanted.span, found)]


def port_of(ref: ast.PortRef, scope: Scope, report: Report) -> ast.PortRef | None:
    """`ref` with the full name of the instance that is meant, through exports if it is a group.

    None where there is none, which is reported.
    """
    found = scope.find(ref.instance.text)
    if found is None:
        _unknown(ref.instance, scope, report)
        return None
    if isinstance(found, str):
        return ast.PortRef(ref.span, Name(ref.instance.span, found), ref.port)
    export = found.exports.get(ref.port.text)
    if export is None:
        _not_exported(ref, found, report)
        return None
    if _leads_back(export, found):
        report.add(
            codes.UNKNOWN_PORT,
            ref.span,
            f"`{ref.port.text}` of `{ref.instance.text}` is exported from itself",
            help="export it from the component that has it",
        )
        return None
    inside = port_of(export.target, found, Report())  # `check_exports` tells what is wrong there
    if inside is None:
        return None
    port = Name(ref.port.span, inside.port.text)
    return ast.PortRef(ref.span, Name(ref.instance.span, inside.instance.text), port)


def _leads_back(export: ast.Export, scope: Scope) -> bool:
    """Whether an export in `scope` comes from groups that export it from each other."""
    followed: list[ast.Export] = []
    following: ast.Export | None = export
    while following is not None:
        if any(one is following for one in followed):
            return True
        followed.append(following)
        target = following.target
        found = scope.find(target.instance.text)
        if not isinstance(found, Scope):
            return False
        following, scope = found.exports.get(target.port.text), found
    return False


def connections_of(scope: Scope, report: Report) -> tuple[list[ast.Connection], set[str]]:
    """All connections between full names, and the full names for which one was not right."""
    made: list[ast.Connection] = []
    troubled: set[str] = set()
    for one in scope.all:
        for tree in one.tree.connections:
            ends = [port_of(end, one, report) for end in (tree.source, tree.target)]
            source, target = ends
            if source is None or target is None:
                troubled.update(end.instance.text for end in ends if end)
            else:
                made.append(ast.Connection(tree.span, source, target, tree.qos))
    return made, troubled


def _unknown(name: Name, scope: Scope, report: Report) -> None:
    known = scope.visible()
    guess = nearest(name.text, known)
    root = [*scope.around][-1]
    hidden = next((one.path for one in root.all if one.path and name.text in one.instances), "")
    inside = f"it is in the group `{hidden}`, from which only exports are seen"
    report.add(
        codes.UNKNOWN_INSTANCE,
        name.span,
        f"there is no component `{name.text}` "
        + ("in this deployment" if not hidden else "that can be seen from here"),
        label=f"did you mean `{guess}`?" if guess else "",
        help=inside if hidden else "" if guess else f"it has {listing(known)}",
        fix=replace(name.span, guess) if guess and not hidden else None,
    )


def _not_exported(ref: ast.PortRef, group: Scope, report: Report) -> None:
    known = list(group.exports)
    guess = nearest(ref.port.text, known)
    name = ref.instance.text
    report.add(
        codes.UNKNOWN_PORT,
        ref.port.span,
        f"the group `{name}` exports no `{ref.port.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(group.tree.name.span, f"`{name}` is declared here")],
        help=f"write `export {ref.port.text} from …;` in it"
        if not known
        else f"it exports {listing(known)}",
        fix=replace(ref.port.span, guess) if guess else None,
    )


def check_exports(scope: Scope, report: Report) -> None:
    """Report exports from something that is not in the group."""
    for one in scope.all:
        for export in one.exports.values():
            name = export.target.instance
            if name.text in one.instances:
                continue
            if name.text in one.groups:
                port_of(export.target, one, report)
                continue
            known = [*one.instances, *one.groups]
            guess = nearest(name.text, known)
            report.add(
                codes.UNKNOWN_INSTANCE,
                name.span,
                f"there is no component `{name.text}` in the group `{one.tree.name.text}`",
                label=f"did you mean `{guess}`?" if guess else "",
                help="" if guess else f"it has {listing(known) or 'none'}",
                fix=replace(name.span, guess) if guess else None,
            )
