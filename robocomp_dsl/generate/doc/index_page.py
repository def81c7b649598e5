"""The first page. In: the site. Out: a page with links to all others."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.generate.doc.graphs import compatibility_figure, deployment_figure
from robocomp_dsl.generate.doc.nodes import (
    Block,
    DocumentationPage,
    Heading,
    Inlines,
    TableRow,
    data_table,
    inline_code,
    join_inlines,
    plain_text,
)
from robocomp_dsl.generate.doc.prose import first_sentence, parse_prose
from robocomp_dsl.generate.doc.site import DocumentationSite
from robocomp_dsl.generate.doc.subject import natural_sort_key
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Interface, Module

PATH = "index"
MAX_GRAPHS = 3
"""Graphs are shown for at most this many deployments."""


def index_page(site: DocumentationSite) -> DocumentationPage:
    """Tables of all pages."""
    return DocumentationPage(PATH, site.subject.title, "Documentation", tuple(_blocks(site)))


def _blocks(site: DocumentationSite) -> Iterator[Block]:
    subject = site.subject
    deployments = [
        TableRow(
            (
                site.link(d),
                join_inlines(inline_code(i.name) for i in d.instances),
                first_sentence(d.doc),
            )
        )
        for d in subject.deployments
    ]
    yield from _section("Deployments", ("deployment", "instances", "what it is"), deployments)
    if len(subject.deployments) in range(1, MAX_GRAPHS + 1):
        yield from (deployment_figure(deployment, site) for deployment in subject.deployments)
    bridges = [
        TableRow((site.link(b), inline_code(b.path.name), first_sentence(b.doc)))
        for b in subject.bridges
    ]
    yield from _section("Bridges", ("bridge", "file", "what it is"), bridges)
    components = [TableRow(_component(component, site)) for component in subject.components]
    yield from _section("Components", ("component", "language", "ports", "what it is"), components)
    fitting = None if deployments else compatibility_figure(site)
    if fitting:
        yield fitting
    head = ("interface", "module", "used by", "what it is")
    pairs = [(interface, module) for module in site.modules for interface in module.interfaces]
    pairs.sort(key=lambda pair: (natural_sort_key(pair[0].name), pair[1].name))
    yield from _section("Interfaces", head, [TableRow(_interface(*pair, site)) for pair in pairs])
    modules = [
        TableRow((site.link(m), inline_code(m.path.name), first_sentence(m.doc)))
        for m in site.modules
    ]
    yield from _section("Modules", ("module", "file", "what it is"), modules)
    sets = [
        TableRow((site.link(p), inline_code(p.path.name), first_sentence(p.doc)))
        for p in subject.parameters
    ]
    yield from _section("Parameters", ("parameters", "file", "what it is"), sets)
    machines = [
        TableRow((site.link(m), inline_code(m.path.name), first_sentence(m.doc)))
        for m in subject.machines
    ]
    yield from _section("State machines", ("state machine", "file", "what it is"), machines)
    if not (deployments or bridges or components or pairs or modules or sets or machines):
        yield from parse_prose("There is nothing here to document.")


def _section(title: str, head: Sequence[str], rows: Sequence[TableRow]) -> Iterator[Block]:
    if rows:
        yield Heading(2, plain_text(title), title.lower().replace(" ", "-"))
        yield from data_table(title, head, rows)


def _component(component: Component, site: DocumentationSite) -> tuple[Inlines, ...]:
    ports = join_inlines(site.declaration_link(port.interface) for port in component.ports)
    return (
        site.link(component),
        plain_text(component.language),
        ports,
        first_sentence(component.doc),
    )


def _interface(
    interface: Interface, module: Module, site: DocumentationSite
) -> tuple[Inlines, ...]:
    users = {site.page(user): site.link(user) for user, _ in site.users(interface)}
    doc = first_sentence(interface.doc or module.doc)
    return site.declaration_link(interface), site.link(module), join_inlines(users.values()), doc
