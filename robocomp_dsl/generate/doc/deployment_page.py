"""The page of a deployment. In: model and site. Out: a page."""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.graphs import deployment_figure, group_figure
from robocomp_dsl.generate.doc.interface_page import pattern_badge
from robocomp_dsl.generate.doc.nodes import (
    SPACE,
    Badge,
    Block,
    DocumentationPage,
    FactTable,
    Heading,
    InlineCode,
    Inlines,
    PlainText,
    TableRow,
    data_table,
    inline_code,
    join_inlines,
    plain_text,
)
from robocomp_dsl.generate.doc.prose import flatten_doc, parse_prose
from robocomp_dsl.generate.doc.site import AnchorNames, DocumentationSite
from robocomp_dsl.model.deployment import (
    Connection,
    Deployment,
    Export,
    External,
    ExternalConnection,
    Group,
    Host,
    Instance,
)
from robocomp_dsl.model.limits_text import format_limits
from robocomp_dsl.model.port_middlewares import connection_middleware
from robocomp_dsl.model.qos_text import qos_statements


def deployment_page(deployment: Deployment, site: DocumentationSite) -> DocumentationPage:
    """Instances and connections of a deployment, and their graph."""
    blocks = tuple(_blocks(deployment, site))
    return DocumentationPage(site.page(deployment), deployment.name, "Deployment", blocks)


def _blocks(deployment: Deployment, site: DocumentationSite) -> Iterator[Block]:
    file = ("File", inline_code(deployment.path.name))
    own = plain_text("that of each component")
    over = inline_code(deployment.middleware) if deployment.middleware else own
    yield FactTable((file, ("Middleware", over)))
    yield from parse_prose(deployment.doc)
    if deployment.instances:
        yield deployment_figure(deployment, site)
    names = AnchorNames()
    anchors = {
        id(instance): names.claim(f"instance.{instance.name}") for instance in deployment.instances
    }
    yield Heading(2, plain_text("Instances"), "instances")
    head = ("instance", "component", "host", "settings", "starts", "restarts", "what it is")
    rows = [
        TableRow(_instance(instance, site), anchors[id(instance)])
        for instance in deployment.instances
    ]
    yield from data_table(f"Instances of {deployment.name}", head, rows)
    if deployment.connections:
        yield Heading(2, plain_text("Connections"), "connections")
    ends = ("from", "to", "interface", "pattern", "over", "quality and monitors")
    wires = [TableRow(_connection(connection, site)) for connection in deployment.connections]
    yield from data_table(f"Connections of {deployment.name}", ends, wires)
    externals = [TableRow(_external(external, site)) for external in deployment.externals]
    if externals:
        yield Heading(2, plain_text("External programs"), "externals")
    columns = ("program", "interface", "how", "over", "address", "what it is")
    yield from data_table("External programs", columns, externals)
    links = [TableRow(_external_connection(link)) for link in deployment.external_connections]
    title = "Connections between external programs"
    if links:
        yield Heading(2, plain_text(title), "external-connections")
    yield from data_table(title, ("from", "to", "over", "carrier"), links)
    groups = [TableRow(_group(group)) for group in deployment.groups]
    if groups:
        yield Heading(2, plain_text("Groups"), "groups")
    yield from data_table("Groups", ("group", "kind", "instances", "exports", "what it is"), groups)
    for group in deployment.groups:
        yield Heading(3, plain_text(f"Group {group.name}"), f"group-{group.name}")
        yield group_figure(deployment, group, site)
    hosts = [TableRow(_host(host)) for host in deployment.hosts]
    if hosts:
        yield Heading(2, plain_text("Hosts"), "hosts")
    yield from data_table("Hosts", ("host", "address", "user", "port", "labels"), hosts)


def _instance(instance: Instance, site: DocumentationSite) -> tuple[Inlines, ...]:
    return (
        inline_code(instance.name),
        plain_text("program") if instance.is_program else site.link(instance.component),
        inline_code(str(instance.placement) or instance.host.name),
        join_inlines(_settings(instance)),
        _start(instance),
        _restart(instance),
        flatten_doc(instance.doc or instance.component.doc),
    )


def _settings(instance: Instance) -> Iterator[Inlines]:
    if instance.prefix:
        yield (PlainText("runs as "), InlineCode(instance.full_name))
    if instance.config:
        yield (PlainText("configuration "), InlineCode(instance.config.name))
    if instance.context:
        yield (PlainText("context "), InlineCode(instance.context))
    if instance.config_name:
        yield (PlainText("configuration "), InlineCode(instance.config_name))
    for key, value in instance.settings:
        yield inline_code(f"{key} = {literals.yaml_value(value)}")
    for key, text in instance.environment:
        yield inline_code(f"${key} = {literals.quoted(text)}")
    if instance.executable != "python3 main.py":
        yield (PlainText("runs "), InlineCode(instance.executable))
    if instance.port:
        yield (PlainText("port "), InlineCode(str(instance.port)))
    if limits := format_limits(instance.limits):
        yield plain_text(limits)


def _start(instance: Instance) -> Inlines:
    after = (
        (PlainText("after "), *join_inlines(map(inline_code, instance.after)), PlainText(", "))
        if instance.after
        else ()
    )
    return (*after, PlainText(f"ready within {instance.start_timeout_s:g} s"))


def _restart(instance: Instance) -> Inlines:
    watchdog = f", watchdog {instance.watchdog_s:g}\u00a0s" if instance.watchdog_s else ""
    if instance.restart.policy == "never":
        return plain_text(f"never{watchdog}")
    most = f" (≤\u00a0{instance.restart.max} in {instance.restart.window_s:g}\u00a0s)"
    return plain_text(f"{instance.restart.policy.replace('-', ' ')}{most}{watchdog}")


def _connection(connection: Connection, site: DocumentationSite) -> tuple[Inlines, ...]:
    used = dict.fromkeys(
        connection.source_port.pattern(o) for o in connection.source_port.interface.operations
    )
    implied = (Badge("implied", "plain"),) if connection.implied else ()
    return (
        inline_code(f"{connection.source.name}.{connection.source_port.name}"),
        inline_code(f"{connection.target.name}.{connection.target_port.name}"),
        site.declaration_link(connection.source_port.interface),
        join_inlines((*map(pattern_badge, used), implied), SPACE),
        inline_code(connection_middleware(connection)),
        join_inlines(_conditions(connection)),
    )


def _conditions(connection: Connection) -> Iterator[Inlines]:
    """The quality of service, monitors and the condition of a connection."""
    if qos := ", ".join(qos_statements(connection.qos)):
        yield plain_text(qos)
    for monitor in connection.monitors:
        yield (PlainText("monitor "), InlineCode(monitor.class_name))
    if connection.condition:
        yield (PlainText("when "), InlineCode(connection.condition))


def _external(external: External, site: DocumentationSite) -> tuple[Inlines, ...]:
    port = external.only_port
    return (
        inline_code(external.name),
        site.declaration_link(port.interface),
        plain_text(str(port.role)),
        inline_code(external.middleware),
        inline_code(external.address),
        flatten_doc(external.doc),
    )


def _external_connection(link: ExternalConnection) -> tuple[Inlines, ...]:
    return (
        inline_code(link.source),
        inline_code(link.target),
        inline_code(link.middleware),
        plain_text(link.carrier),
    )


def _group(group: Group) -> tuple[Inlines, ...]:
    exports = (
        (InlineCode(f"{export.instance.name}.{export.port.name}"), *_export_alias(export))
        for export in group.exports
    )
    kind = (PlainText("instance of "), InlineCode(group.definition)) if group.definition else ()
    process = plain_text("one process") if group.inprocess else ()
    prefix = (PlainText("prefix "), InlineCode(group.prefix)) if group.prefix else ()
    return (
        inline_code(group.name),
        join_inlines(part for part in (kind, process, prefix) if part),
        join_inlines(map(inline_code, group.instances)),
        join_inlines(exports),
        flatten_doc(group.doc),
    )


def _export_alias(export: Export) -> Inlines:
    return () if export.name == export.port.name else (PlainText(" as "), InlineCode(export.name))


def _host(host: Host) -> tuple[Inlines, ...]:
    return (
        inline_code(host.name),
        inline_code(host.address),
        inline_code(host.user),
        inline_code(str(host.port or "")),
        join_inlines(map(inline_code, host.labels)),
    )
