"""The first page. In: the site. Out: a page that leads to all others."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.generate.doc.graphs import deployment_figure, fitting_figure
from robocomp_dsl.generate.doc.prose import prose, sentence
from robocomp_dsl.generate.doc.site import Site
from robocomp_dsl.generate.doc.subject import natural
from robocomp_dsl.generate.doc.words import (
    Block,
    Heading,
    Page,
    Row,
    Words,
    code,
    joined,
    table,
    text,
)
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Interface, Module

PATH = "index"
MOST_GRAPHS = 3
"""With more deployments the first page would be all graphs."""


def index_page(site: Site) -> Page:
    """Tables of everything that has a page."""
    return Page(PATH, site.subject.title, "Documentation", tuple(_blocks(site)))


def _blocks(site: Site) -> Iterator[Block]:
    subject = site.subject
    deployments = [
        Row((site.link(d), joined(code(i.name) for i in d.instances), sentence(d.doc)))
        for d in subject.deployments
    ]
    yield from _section("Deployments", ("deployment", "instances", "what it is"), deployments)
    if len(subject.deployments) in range(1, MOST_GRAPHS + 1):
        yield from (deployment_figure(one, site) for one in subject.deployments)
    components = [Row(_component(one, site)) for one in subject.components]
    yield from _section("Components", ("component", "language", "ports", "what it is"), components)
    fitting = None if deployments else fitting_figure(site)
    if fitting:
        yield fitting
    head = ("interface", "module", "used by", "what it is")
    pairs = [(one, module) for module in site.modules for one in module.interfaces]
    pairs.sort(key=lambda pair: (natural(pair[0].name), pair[1].name))
    yield from _section("Interfaces", head, [Row(_interface(*pair, site)) for pair in pairs])
    modules = [Row((site.link(m), code(m.path.name), sentence(m.doc))) for m in site.modules]
    yield from _section("Modules", ("module", "file", "what it is"), modules)
    sets = [Row((site.link(p), code(p.path.name), sentence(p.doc))) for p in subject.parameters]
    yield from _section("Parameters", ("parameters", "file", "what it is"), sets)
    machines = [Row((site.link(m), code(m.path.name), sentence(m.doc))) for m in subject.machines]
    yield from _section("State machines", ("state machine", "file", "what it is"), machines)
    if not (deployments or components or pairs or modules or sets or machines):
        yield from prose("There is nothing here to document.")


def _section(title: str, head: Sequence[str], rows: Sequence[Row]) -> Iterator[Block]:
    if rows:
        yield Heading(2, text(title), title.lower().replace(" ", "-"))
        yield from table(title, head, rows)


def _component(one: Component, site: Site) -> tuple[Words, ...]:
    ports = joined(site.declared(port.interface) for port in one.ports)
    return site.link(one), text(one.language), ports, sentence(one.doc)


def _interface(one: Interface, module: Module, site: Site) -> tuple[Words, ...]:
    users = {site.page(user): site.link(user) for user, _ in site.users(one)}
    doc = sentence(one.doc or module.doc)
    return site.declared(one), site.link(module), joined(users.values()), doc
