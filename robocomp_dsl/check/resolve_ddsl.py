"""From the tree of a DDSL file to its deployment.

In: the tree, a workspace, and the passes of a component. Out: a `Deployment` with what could be
understood, and the findings of this file and the errors of those that it imports.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from ipaddress import ip_address

from robocomp_dsl.check import codes
from robocomp_dsl.check.clocks import clock_of
from robocomp_dsl.check.components import CheckComponent, imported_components
from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.groups import groups_of, seen
from robocomp_dsl.check.implied_wires import implied_wires
from robocomp_dsl.check.instances import Surroundings, instance_of, report_shared_ports
from robocomp_dsl.check.middlewares import middleware_of
from robocomp_dsl.check.names import without_repeats
from robocomp_dsl.check.order import start_order
from robocomp_dsl.check.scopes import Scope, check_exports, connections_of, flat, scopes_of
from robocomp_dsl.check.wiring import written_wires
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import THIS_MACHINE, Deployment, Host, Instance
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Name

_ADDRESS = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9_.-]*[A-Za-z0-9])?")
"""A name, or numbers of IP version 4."""


def resolve_ddsl(
    file: Parsed[ast.File], workspace: Workspace, check: CheckComponent, report: Report
) -> Deployment | None:
    """The deployment that a file describes; None where none is to be seen."""
    tree = file.tree.deployment
    path = file.source.path
    imported = imported_components(file.tree.imports, path, workspace, check, report)
    if tree is None:
        return None
    hosts = {
        one.name.text: _host(one, report) for one in without_repeats(tree.hosts, "host", report)
    }
    around = Surroundings(path, imported, hosts, workspace)
    scope = scopes_of(tree, report)
    trees = flat(scope, report)
    made = {one.name.text: instance_of(one, group, around, report) for one, group in trees}
    known = {name: one for name, one in made.items() if one is not None}
    unclear = made.keys() - known.keys()
    if not trees and not tree.groups:
        report.add(codes.EMPTY_DEPLOYMENT, tree.name.span, f"`{tree.name.text}` has no components")
    report_shared_ports([one for one, _ in trees], report)
    order = [known[name] for name in start_order(scope, report) if name in known]
    written = written_wires(*_connections(scope, known, report), report)
    check_exports(scope, report)
    groups = groups_of(scope, known, report)
    whole = not (unclear or imported.broken) and file.tree.complete
    implied = implied_wires(
        list(known.values()), written, imported, seen(scope), report, whole=whole
    )
    return Deployment(
        name=tree.name.text,
        path=path,
        span=tree.name.span,
        middleware=middleware_of(tree.middleware, workspace.middlewares, report),
        instances=tuple(order),
        connections=(*written.wires, *implied),
        hosts=tuple(hosts.values()),
        doc=tree.doc,
        groups=groups,
        clock=clock_of(tree.clock, order, whole=whole, report=report),
    )


def _connections(
    scope: Scope, known: Mapping[str, Instance], report: Report
) -> tuple[list[ast.Connection], Mapping[str, Instance], set[str]]:
    trees, troubled = connections_of(scope, report)
    return trees, known, troubled


def _host(tree: ast.Host, report: Report) -> Host:
    user = tree.user.text if isinstance(tree.user, Name) else tree.user.value if tree.user else ""
    labels = tuple(one.text for one in tree.labels)
    return Host(tree.name.text, _address(tree, report), user, labels, tree.name.span)


def _address(tree: ast.Host, report: Report) -> str:
    """A name or a number by which the machine is reached."""
    name = tree.name.text
    if tree.address is None:
        if name == THIS_MACHINE:
            return THIS_MACHINE
        said = f"the host `{name}` has no address"
        right = f'write `host {name} {{ address "10.0.0.2"; }};`, or a name instead of the number'
        report.add(codes.HOST_ADDRESS, tree.name.span, said, help=right)
        return ""
    written = tree.address.value.strip()
    if not _ADDRESS.fullmatch(written) and not _is_number(written):
        said = f'"{written:.60}" is no address of a machine'
        right = "it is a name such as `robot.local`, or numbers such as `10.0.0.2`"
        report.add(codes.HOST_ADDRESS, tree.address.span, said, help=right)
        return ""
    return written


def _is_number(written: str) -> bool:
    try:
        ip_address(written)
    except ValueError:
        return False
    return True
