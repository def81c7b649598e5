"""The page of a deployment. In: model and site. Out: a page."""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.graphs import deployment_figure
from robocomp_dsl.generate.doc.interface_page import badge
from robocomp_dsl.generate.doc.prose import inline_doc, prose
from robocomp_dsl.generate.doc.site import Names, Site
from robocomp_dsl.generate.doc.words import (
    BLANK,
    Badge,
    Block,
    Code,
    Facts,
    Heading,
    Page,
    Row,
    Text,
    Words,
    code,
    joined,
    table,
    text,
)
from robocomp_dsl.model.deployment import Connection, Deployment, Export, Group, Host, Instance, Qos


def deployment_page(deployment: Deployment, site: Site) -> Page:
    """Instances and wires of a deployment, and the graph of both."""
    blocks = tuple(_blocks(deployment, site))
    return Page(site.page(deployment), deployment.name, "Deployment", blocks)


def _blocks(deployment: Deployment, site: Site) -> Iterator[Block]:
    file = ("File", code(deployment.path.name))
    yield Facts((file, ("Middleware", code(deployment.middleware))))
    yield from prose(deployment.doc)
    if deployment.instances:
        yield deployment_figure(deployment, site)
    names = Names()
    anchors = {id(one): names.claim(f"instance.{one.name}") for one in deployment.instances}
    yield Heading(2, text("Instances"), "instances")
    head = ("instance", "component", "host", "settings", "starts", "restarts", "what it is")
    rows = [Row(_instance(one, site), anchors[id(one)]) for one in deployment.instances]
    yield from table(f"Instances of {deployment.name}", head, rows)
    if deployment.connections:
        yield Heading(2, text("Wires"), "wires")
    ends = ("from", "to", "interface", "pattern", "quality")
    wires = [Row(_wire(one, site)) for one in deployment.connections]
    yield from table(f"Wires of {deployment.name}", ends, wires)
    groups = [Row(_group(one)) for one in deployment.groups]
    if groups:
        yield Heading(2, text("Groups"), "groups")
    yield from table("Groups", ("group", "instances", "exports", "what it is"), groups)
    hosts = [Row(_host(one)) for one in deployment.hosts]
    if hosts:
        yield Heading(2, text("Hosts"), "hosts")
    yield from table("Hosts", ("host", "address", "user", "labels"), hosts)


def _instance(one: Instance, site: Site) -> tuple[Words, ...]:
    return (
        code(one.name),
        site.link(one.component),
        code(one.host.name),
        joined(_settings(one)),
        _start(one),
        _restart(one),
        inline_doc(one.doc or one.component.doc),
    )


def _settings(one: Instance) -> Iterator[Words]:
    if one.prefix:
        yield (Text("runs as "), Code(one.whole_name))
    if one.config:
        yield (Text("configuration "), Code(one.config.name))
    if one.context:
        yield (Text("context "), Code(one.context))
    if one.searched:
        yield (Text("configuration "), Code(one.searched))
    for key, value in one.settings:
        yield code(f"{key} = {literals.yaml_value(value)}")
    for key, said in one.environment:
        yield code(f"${key} = {literals.quoted(said)}")
    if one.executable != "python3 main.py":
        yield (Text("runs "), Code(one.executable))
    if one.port:
        yield (Text("port "), Code(str(one.port)))


def _start(one: Instance) -> Words:
    after = (Text("after "), *joined(map(code, one.after)), Text(", ")) if one.after else ()
    return (*after, Text(f"ready within {one.ready_within_s:g} s"))


def _restart(one: Instance) -> Words:
    if one.restart.policy == "never":
        return text("never")
    most = f" (≤\u00a0{one.restart.max} in {one.restart.window_s:g}\u00a0s)"
    return text(f"{one.restart.policy.replace('-', ' ')}{most}")


def _wire(one: Connection, site: Site) -> tuple[Words, ...]:
    used = dict.fromkeys(one.source_port.pattern(o) for o in one.source_port.interface.operations)
    implied = (Badge("implied", "plain"),) if one.implied else ()
    return (
        code(f"{one.source.name}.{one.source_port.name}"),
        code(f"{one.target.name}.{one.target_port.name}"),
        site.declared(one.source_port.interface),
        joined((*map(badge, used), implied), BLANK),
        text(quality(one.qos)),
    )


def quality(qos: Qos) -> str:
    """What was written about the quality of service; empty for nothing."""
    reliable = {True: "reliable", False: "best effort", None: ""}[qos.reliable]
    priority = f"priority {qos.priority}" if qos.priority else ""
    depth = "" if qos.depth is None else f"depth {qos.depth}"
    deadline = "" if qos.deadline_ms is None else f"deadline {qos.deadline_ms:g} ms"
    return ", ".join(part for part in (reliable, priority, depth, deadline) if part)


def _group(one: Group) -> tuple[Words, ...]:
    exports = (
        (Code(f"{export.instance.name}.{export.port.name}"), *_renamed(export))
        for export in one.exports
    )
    return code(one.name), joined(map(code, one.instances)), joined(exports), inline_doc(one.doc)


def _renamed(export: Export) -> Words:
    return () if export.name == export.port.name else (Text(" as "), Code(export.name))


def _host(one: Host) -> tuple[Words, ...]:
    return code(one.name), code(one.address), code(one.user), joined(map(code, one.labels))
