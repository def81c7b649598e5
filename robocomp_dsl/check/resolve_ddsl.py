"""From the tree of a DDSL file to its deployment.

In: the tree, a workspace, and the passes of a component. Out: a `Deployment` with what could be
understood, and the findings of this file and the errors of those that it imports.
"""

from __future__ import annotations

from collections.abc import Sequence
from ipaddress import ip_address

from robocomp_dsl.check import codes
from robocomp_dsl.check.components import CheckComponent, imported_components
from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.implied_wires import implied_wires
from robocomp_dsl.check.instances import Surroundings, instance_of, report_shared_ports
from robocomp_dsl.check.middlewares import middleware_of
from robocomp_dsl.check.names import without_repeats
from robocomp_dsl.check.order import start_order
from robocomp_dsl.check.wiring import written_wires
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import Deployment, Host
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Name


def resolve_ddsl(
    file: Parsed[ast.File], workspace: Workspace, check: CheckComponent, report: Report
) -> Deployment | None:
    """The deployment that a file describes; None where none is to be seen."""
    tree = file.tree.deployment
    path = file.source.path
    imported = imported_components(file.tree.imports, path, workspace, check, report)
    if tree is None:
        return None
    hosts = {one.name.text: _host(one) for one in without_repeats(tree.hosts, "host", report)}
    around = Surroundings(path, imported, hosts, workspace)
    trees = without_repeats(tree.instances, "component", report)
    made = {one.name.text: instance_of(one, around, report) for one in trees}
    known = {name: one for name, one in made.items() if one is not None}
    unclear = frozenset(made.keys() - known.keys())
    _judge_place(tree, trees, around, report)
    report_shared_ports(trees, report)
    order = [known[name] for name in start_order(trees, report) if name in known]
    written = written_wires(tree.connections, known, unclear, report)
    whole = not (unclear or imported.broken or tree.groups) and file.tree.complete
    implied = implied_wires(list(known.values()), written, imported, report, whole=whole)
    return Deployment(
        name=tree.name.text,
        path=path,
        span=tree.name.span,
        middleware=middleware_of(tree.middleware, workspace.middlewares, report),
        instances=tuple(order),
        connections=(*written.wires, *implied),
        hosts=tuple(hosts.values()),
        doc=tree.doc,
    )


def _host(tree: ast.Host) -> Host:
    user = tree.user.text if isinstance(tree.user, Name) else tree.user.value if tree.user else ""
    address = tree.address.value if tree.address else ""
    labels = tuple(one.text for one in tree.labels)
    return Host(tree.name.text, address, user, labels, tree.name.span)


def is_this_machine(host: Host) -> bool:
    """Whether a host is the machine on which the deployment is started."""
    if host.address == "localhost":
        return True
    try:
        return ip_address(host.address).is_loopback
    except ValueError:
        return False


def _judge_place(
    tree: ast.Deployment, trees: Sequence[ast.Instance], around: Surroundings, report: Report
) -> None:
    """Report other machines and groups, which can be written but not run yet."""
    for one in trees:
        host = around.hosts.get(one.host.text) if one.host else None
        if one.host and host and not is_this_machine(host):
            report.add(
                codes.SEVERAL_HOSTS,
                one.host.span,
                f"`{one.name.text}` is on `{host.name}`, but several hosts are not supported yet",
                notes=[Note(host.span, f"`{host.name}` is declared here")] if host.span else [],
                help="leave out `on`, and the component runs on this machine",
            )
    for group in tree.groups:
        report.add(
            codes.GROUPS,
            group.name.span,
            f"the group `{group.name.text}` cannot be deployed: groups are not supported yet",
            help="write its components and connections into the deployment itself",
        )
    if not tree.instances and not tree.groups:
        report.add(codes.EMPTY_DEPLOYMENT, tree.name.span, f"`{tree.name.text}` has no components")
