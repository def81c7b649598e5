"""The pages of interfaces and of their modules. In: model and site. Out: pages."""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate.doc.prose import prose, sentence
from robocomp_dsl.generate.doc.site import Names, Site, type_anchor
from robocomp_dsl.generate.doc.types_shown import type_blocks, types_behind
from robocomp_dsl.generate.doc.words import (
    BLANK,
    Badge,
    Block,
    Code,
    Facts,
    Heading,
    Page,
    Row,
    Signature,
    Target,
    Words,
    code,
    joined,
    table,
    text,
)
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.interface import Interface, Module, Operation, Param, Pattern

LONGEST_SIGNATURE = 84
"""Characters of an operation on one line."""

ROLES = {
    Role.IMPLEMENTS: "implements it",
    Role.REQUIRES: "requires it",
    Role.PUBLISHES: "publishes it",
    Role.SUBSCRIBES: "subscribes to it",
}


def interface_page(interface: Interface, module: Module, site: Site) -> Page:
    """Operations, the types that they speak of, and the components that speak them."""
    path = site.target(interface).page
    return Page(path, interface.name, "Interface", tuple(_interface(interface, module, site)))


def module_page(module: Module, site: Site) -> Page:
    """Interfaces, types and exceptions of one module."""
    return Page(site.page(module), module.name, "Module", tuple(_module(module, site)))


def _interface(interface: Interface, module: Module, site: Site) -> Iterator[Block]:
    used = types_behind(interface)
    names = Names()
    anchors = {id(one): names.claim(type_anchor(one)) for one in used}
    here = site.showing(anchors)
    yield Facts((("Module", site.link(module)), ("File", code(module.path.name))))
    yield from prose(interface.doc or module.doc)
    if interface.operations:
        yield Heading(2, text("Operations"), "operations")
    for one, anchor in zip(interface.operations, operation_anchors(interface), strict=True):
        yield from _operation(one, anchor, here)
    if used:
        yield Heading(2, text("Types"), "types")
    for type_ in used:
        yield from type_blocks(type_, anchors[id(type_)], here)
    yield Heading(2, text("Who uses it"), "users")
    yield from _users(interface, site)


def _users(interface: Interface, site: Site) -> Iterator[Block]:
    rows = [
        Row((site.link(one), text(ROLES[port.role]), code(port.name), sentence(one.doc)))
        for one, port in site.users(interface)
    ]
    head = ("component", "how", "port", "what it is")
    yield from table(f"Components that use {interface.name}", head, rows)
    if not rows:
        yield from prose("No component that is documented here.")


def _operation(one: Operation, anchor: str, site: Site) -> Iterator[Block]:
    again = (Badge("idempotent", "plain"),) if one.idempotent else ()
    marks = (badge(pattern) for pattern in patterns(one))
    yield Heading(3, joined(((Code(one.name),), *marks, again), BLANK), anchor)
    yield Signature(tuple(_signature(one, site)))
    yield from prose(one.doc)


def _signature(one: Operation, site: Site) -> Iterator[Words]:
    """On one line where it is short, else with a line for each parameter."""
    result = site.type(one.result) if one.result else code("void")
    params = [_param(p, site) for p in one.inputs]
    params += [(Code("out "), *_param(p, site)) for p in one.outputs]
    throws = joined(map(site.declared, one.throws), Code(", "))
    tail = (Code(" throws "), *throws, Code(";")) if throws else (Code(";"),)
    head = (*result, Code(f" {one.name}("))
    whole = (*head, *joined(params, Code(", ")), Code(")"), *tail)
    if sum(len(part.text) for part in whole) <= LONGEST_SIGNATURE:
        yield whole
        return
    yield head
    for i, words in enumerate(params, 1):
        yield (Code("    "), *words, *((Code(","),) if i < len(params) else ()))
    yield (Code(")"), *tail)


def _param(one: Param, site: Site) -> Words:
    unit = f" [{one.unit}]" if one.unit else ""
    return (*site.type(one.type), Code(f" {one.name}{unit}"))


def operations(interface: Interface, site: Site) -> list[tuple[Operation, Words]]:
    """Its operations, and their names as links."""
    page = site.target(interface).page
    anchors = operation_anchors(interface)
    return [
        (one, code(one.name, Target(page, anchor)))
        for one, anchor in zip(interface.operations, anchors, strict=True)
    ]


def operation_anchors(interface: Interface) -> list[str]:
    """The places of its operations in its page."""
    names = Names()
    return [names.claim(f"operation.{one.name}") for one in interface.operations]


def patterns(one: Operation) -> tuple[Pattern, ...]:
    """Its pattern, or both that an unmarked operation may have."""
    if one.pattern is Pattern.UNMARKED:
        return (one.as_service(), one.as_topic())
    return (one.pattern,)


def badge(pattern: Pattern) -> Words:
    """The mark of a pattern."""
    return (Badge(pattern.value, pattern.value),)


def _module(module: Module, site: Site) -> Iterator[Block]:
    imports = joined(map(site.link, module.imports))
    yield Facts((("File", code(module.path.name)), *((("Imports", imports),) if imports else ())))
    yield from prose(module.doc)
    rows = [
        Row((site.declared(one), joined(w for _, w in operations(one, site)), sentence(one.doc)))
        for one in module.interfaces
    ]
    if rows:
        yield Heading(2, text("Interfaces"), "interfaces")
        yield from table(
            f"Interfaces of {module.name}", ("interface", "operations", "what it is"), rows
        )
    types = [one for one in module.declarations if not isinstance(one, Interface)]
    if types:
        yield Heading(2, text("Types"), "types")
    here = site.showing({id(one): type_anchor(one) for one in types})
    for one in types:
        yield from type_blocks(one, type_anchor(one), here)
