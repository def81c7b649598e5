"""Resolves `extern` of a deployment: programs that other people start.

In: the tree nodes and the imported components. Out: `External` values, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from robocomp_dsl.check.cdsl.middlewares import find_middleware
from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.check.ddsl.components import ImportedComponents
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.deployment import HERE, Connection, External
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import QualifiedName

_ROLES = {role.value.lower(): role for role in Role}


def resolve_externals(
    trees: Iterable[ast.External],
    path: Path,
    imported: ImportedComponents,
    known: KnownMiddlewares,
    report: Report,
) -> dict[str, External]:
    """The valid external programs by name. `path` is that of the DDSL file."""
    resolved = (_external(tree, path, imported, known, report) for tree in trees)
    return {external.name: external for external in resolved if external is not None}


def report_unused_externals(
    externals: Iterable[External], connections: Sequence[Connection], report: Report
) -> None:
    """Report external programs without a connection."""
    used = {id(end) for wire in connections for end in (wire.source, wire.target)}
    for external in externals:
        if id(external) not in used:
            report.add(
                codes.UNUSED_EXTERNAL,
                external.span,
                f"the external program `{external.name}` is not connected",
                help=f"connect it: {_example(external)}",
            )


def _example(external: External) -> str:
    own = f"{external.name}.{external.only_port.name}"
    other = f"component.{external.only_port.name}"
    inward = external.only_port.role in (Role.IMPLEMENTS, Role.SUBSCRIBES)
    ends = (other, own) if inward else (own, other)
    return f"`connect {' -> '.join(ends)};`"


def _external(
    tree: ast.External,
    path: Path,
    imported: ImportedComponents,
    known: KnownMiddlewares,
    report: Report,
) -> External | None:
    middleware = find_middleware(tree.over, known, report)
    role = _ROLES[tree.role.text.lower()]
    address = _address(tree, role, report)
    interface = _interface(tree.interface, imported, report)
    if not middleware or address is None or interface is None:
        return None
    if not _accepts_external_peers(tree, middleware, known, report):
        return None
    port = Port(role, interface, interface.name, tree.interface.span, (middleware,))
    component = Component(tree.name.text, path, tree.name.span, "", (), (port,))
    return External(
        name=tree.name.text,
        component=component,
        span=tree.name.span,
        host=HERE,
        middleware=middleware,
        address=address,
        doc=tree.doc,
    )


def _accepts_external_peers(
    tree: ast.External, middleware: str, known: KnownMiddlewares, report: Report
) -> bool:
    description = known.describe(middleware)
    if description is None or description.capabilities.external_peers:
        return True
    able = [name for name in known.names() if _has_external_peers(name, known)]
    report.add(
        codes.UNSUITABLE_MIDDLEWARE,
        tree.over.span,
        f"`{middleware}` connects components only; `{tree.name.text}` is an external program",
        help=f"external programs are reached over {join_names(able)}" if able else "",
    )
    return False


def _has_external_peers(name: str, known: KnownMiddlewares) -> bool:
    description = known.describe(name)
    return description is not None and description.capabilities.external_peers


def _address(tree: ast.External, role: Role, report: Report) -> str | None:
    """The address; empty for a client, None if it is missing."""
    if role is Role.REQUIRES:
        if tree.address is not None:
            report.add(
                codes.ADDRESS,
                tree.address.span,
                f"`{tree.name.text}` is a client: it has no address",
                help=f"give the port that it calls one: `port {tree.interface.name.text} over "
                f'{tree.over.text} at "…";` in the component',
            )
        return ""
    written = tree.address.value.strip() if tree.address else ""
    if written:
        return written
    report.add(
        codes.ADDRESS,
        (tree.address or tree.name).span,
        f"the external program `{tree.name.text}` has no address",
        help=f'write `over {tree.over.text} at "…"`',
    )
    return None


def _interface(
    name: QualifiedName, imported: ImportedComponents, report: Report
) -> Interface | None:
    used = {
        port.interface.qualified: port.interface
        for component in imported.components.values()
        for port in component.ports
    }
    found = [
        interface
        for interface in used.values()
        if name.text in (interface.name, interface.qualified)
    ]
    if found:
        return found[0]
    if imported.broken:
        return None
    names = list(dict.fromkeys(interface.name for interface in used.values()))
    guess = nearest(name.name.text, names)
    report.add(
        codes.EXTERNAL_INTERFACE,
        name.span,
        f"no component of this deployment uses the interface `{name.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help="" if guess else f"they use {join_names(names) or 'no interfaces'}",
        fix=replace_fix(name.name.span, guess) if guess else None,
    )
    return None
