"""Resolves the deployment of a DDSL file.

In: the tree, a workspace, and the check of a component. Out: a possibly partial `Deployment`, the
diagnostics of this file, and the errors of the files that it imports.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from robocomp_dsl.check.cdsl.middlewares import find_middleware
from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.carriers import check_carriers, check_deployment_middleware
from robocomp_dsl.check.ddsl.check_definitions import check_definitions, located_at_instances
from robocomp_dsl.check.ddsl.clock_hosts import check_clock_hosts
from robocomp_dsl.check.ddsl.clocks import resolve_clock
from robocomp_dsl.check.ddsl.components import CheckComponent
from robocomp_dsl.check.ddsl.connections import ExplicitConnections, explicit_connections
from robocomp_dsl.check.ddsl.definitions import DefinitionFile, DefinitionFiles
from robocomp_dsl.check.ddsl.external_connections import resolve_external_connections
from robocomp_dsl.check.ddsl.externals import report_unused_externals, resolve_externals
from robocomp_dsl.check.ddsl.flatten import arbitrations_of, connections_of, flatten
from robocomp_dsl.check.ddsl.groups import check_exports, resolve_groups, visible_exports
from robocomp_dsl.check.ddsl.hosts import resolve_hosts
from robocomp_dsl.check.ddsl.implicit_connections import implicit_connections
from robocomp_dsl.check.ddsl.instances import InstanceContext, report_shared_ports, resolve_instance
from robocomp_dsl.check.ddsl.interface_versions import check_interface_versions
from robocomp_dsl.check.ddsl.monitored_servers import check_monitored_servers
from robocomp_dsl.check.ddsl.monitors import ConnectionContext
from robocomp_dsl.check.ddsl.one_process import (
    check_processes,
    processes_of_instances,
    within_processes,
)
from robocomp_dsl.check.ddsl.order import start_order
from robocomp_dsl.check.ddsl.own_ports import report_shared_addresses
from robocomp_dsl.check.ddsl.places import resolve_places
from robocomp_dsl.check.ddsl.scopes import (
    DeploymentScope,
    scopes_of,
)
from robocomp_dsl.check.doc_comments import plain
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Connection, Deployment, Instance
from robocomp_dsl.syntax.ast import ddsl as ast


def resolve_ddsl(
    file: Parsed[ast.File], workspace: Workspace, check: CheckComponent, report: Report
) -> Deployment | None:
    """The deployment of a file; None if it has none."""
    definitions = DefinitionFiles(workspace, check)
    own = definitions.load(file, report)
    resolver = _Resolver(definitions, workspace)
    if not any(loaded.groups for loaded in definitions.files.values()):
        return resolver.resolve(own, own.tree.deployment, report) if own.tree.deployment else None
    known = check_definitions(definitions, own, resolver.check_definition, report)
    if own.tree.deployment is None:
        return None
    found = Report()
    deployment = resolver.resolve(own, own.tree.deployment, found)
    report.extend(located_at_instances(found, known, resolver.scope))
    return deployment


class _Resolver:
    """Resolves deployments of one file; `scope` is that of the latest."""

    def __init__(self, definitions: DefinitionFiles, workspace: Workspace) -> None:
        self._definitions = definitions
        self._workspace = workspace
        self.scope: DeploymentScope

    def check_definition(
        self, file: DefinitionFile, deployment: ast.Deployment, report: Report
    ) -> None:
        """Check a deployment that contains one instance of a definition."""
        self.resolve(file, deployment, report, is_whole=False)

    def resolve(
        self,
        file: DefinitionFile,
        tree: ast.Deployment,
        report: Report,
        *,
        is_whole: bool = True,
    ) -> Deployment:
        """The deployment of `tree`; unless `is_whole`, missing peers are not reported."""
        workspace, imported = self._workspace, file.components
        path = tree.span.source.path
        hosts = resolve_hosts(tree.hosts, report)
        scope = self.scope = scopes_of(tree, self._definitions, report)
        if self._definitions.is_exceeded:
            return Deployment(tree.name.text, path, tree.name.span, "", (), ())
        places = resolve_places(scope, hosts, report)
        context = InstanceContext(self._definitions, places, workspace)
        trees = flatten(scope)
        resolved = {
            node.name.text: resolve_instance(node, group, context, report) for node, group in trees
        }
        processes = processes_of_instances(scope)
        known = {
            name: node.replace(process=processes.get(name, ""))
            for name, node in resolved.items()
            if node is not None
        }
        check_processes(scope, known, report)
        unclear = resolved.keys() - known.keys()
        if not (trees or tree.groups or tree.external_connections):
            message = f"`{tree.name.text}` has no components"
            report.add(codes.EMPTY_DEPLOYMENT, tree.name.span, message)
        report_shared_ports([node for node, _ in trees], places, report)
        order = [known[name] for name in start_order(scope, report) if name in known]
        known_middlewares = workspace.middlewares
        externals = resolve_externals(
            scope.externals.values(), path, imported, known_middlewares, report
        )
        connection_context = ConnectionContext(workspace, {})
        written = _connections(scope, {**known, **externals}, connection_context, report)
        report_unused_externals(externals.values(), written.connections, report)
        report_shared_addresses(order, [node for node, _ in trees], report)
        check_exports(scope, report)
        groups = resolve_groups(scope, known, report)
        complete = is_whole and not (unclear or imported.broken) and file.tree.complete
        complete = complete and not scope.has_unknown_groups
        implied = implicit_connections(
            list(known.values()),
            written,
            imported,
            visible_exports(scope),
            report,
            unclear=unclear,
            complete=complete,
        )
        all_connections = within_processes((*written.connections, *implied), known_middlewares)
        check_monitored_servers(all_connections, report)
        middleware = find_middleware(tree.middleware, known_middlewares, report)
        if middleware and tree.middleware:
            middleware = check_deployment_middleware(
                middleware, tree.middleware.span, known_middlewares, report
            )
        valid = [c for c in all_connections if not _follows_error(c, written.faulty_instances)]
        check_carriers(valid, middleware, hosts, known_middlewares, report)
        check_interface_versions(valid, middleware, known_middlewares, report)
        clock = resolve_clock(tree.clock, order, complete=complete, report=report)
        check_clock_hosts(tree.clock, clock, order, hosts, report)
        return Deployment(
            name=tree.name.text,
            path=path,
            span=tree.name.span,
            middleware=middleware,
            instances=tuple(order),
            connections=all_connections,
            hosts=tuple(hosts.values()),
            doc=plain(tree.doc),
            groups=groups,
            clock=clock,
            externals=tuple(externals.values()),
            external_connections=resolve_external_connections(
                tree.external_connections, known_middlewares, report
            ),
        )


def _connections(
    scope: DeploymentScope,
    ends: Mapping[str, Instance],
    context: ConnectionContext,
    report: Report,
) -> ExplicitConnections:
    """The connections that are written, with their conditions."""
    trees, faulty = connections_of(scope, report)
    written = explicit_connections(trees, ends, faulty, context, report)
    if arbitrations := arbitrations_of(scope, report):
        from robocomp_dsl.check.ddsl.arbitrations import apply_arbitrations  # noqa: PLC0415 - few files need it

        apply_arbitrations(arbitrations, ends, written, context, report)
    return written


def _follows_error(connection: Connection, faulty: Collection[str]) -> bool:
    """Whether a connection is implied only because the written one is invalid."""
    return connection.implied and (
        connection.source.name in faulty or connection.target.name in faulty
    )
