"""The pages of interfaces and of their modules. In: model and site. Out: pages."""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate.doc.nodes import (
    SPACE,
    Badge,
    Block,
    DeclarationBlock,
    DocumentationPage,
    FactTable,
    Heading,
    InlineCode,
    Inlines,
    TableRow,
    data_table,
    inline_code,
    join_inlines,
    plain_text,
)
from robocomp_dsl.generate.doc.prose import first_sentence, parse_prose
from robocomp_dsl.generate.doc.site import AnchorNames, DocumentationSite, type_anchor
from robocomp_dsl.generate.doc.target import Target
from robocomp_dsl.generate.doc.types_shown import referenced_types, type_blocks
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.interface import Interface, Module, Operation, Param, Pattern

MAX_SIGNATURE_LENGTH = 84
"""Characters of an operation on one line."""

ROLES = {
    Role.IMPLEMENTS: "implements it",
    Role.REQUIRES: "requires it",
    Role.PUBLISHES: "publishes it",
    Role.SUBSCRIBES: "subscribes to it",
}


def interface_page(
    interface: Interface, module: Module, site: DocumentationSite
) -> DocumentationPage:
    """Operations, the types that they use, and the components that use the interface."""
    path = site.target(interface).page
    return DocumentationPage(
        path, interface.name, "Interface", tuple(_interface(interface, module, site))
    )


def module_page(module: Module, site: DocumentationSite) -> DocumentationPage:
    """Interfaces, types and exceptions of one module."""
    return DocumentationPage(site.page(module), module.name, "Module", tuple(_module(module, site)))


def _interface(interface: Interface, module: Module, site: DocumentationSite) -> Iterator[Block]:
    used = referenced_types(interface)
    names = AnchorNames()
    anchors = {id(declaration): names.claim(type_anchor(declaration)) for declaration in used}
    here = site.with_local_anchors(anchors)
    yield FactTable((("Module", site.link(module)), ("File", inline_code(module.path.name))))
    yield from parse_prose(interface.doc or module.doc)
    if interface.operations:
        yield Heading(2, plain_text("Operations"), "operations")
    for operation, anchor in zip(interface.operations, operation_anchors(interface), strict=True):
        yield from _operation(operation, anchor, here)
    if used:
        yield Heading(2, plain_text("Types"), "types")
    for type_ in used:
        yield from type_blocks(type_, anchors[id(type_)], here)
    yield Heading(2, plain_text("Used by"), "users")
    yield from _users(interface, site)


def _users(interface: Interface, site: DocumentationSite) -> Iterator[Block]:
    rows = [
        TableRow(
            (
                site.link(component),
                plain_text(ROLES[port.role]),
                inline_code(port.name),
                first_sentence(component.doc),
            )
        )
        for component, port in site.users(interface)
    ]
    head = ("component", "how", "port", "what it is")
    yield from data_table(f"Components that use {interface.name}", head, rows)
    if not rows:
        yield from parse_prose("No documented component uses it.")


def _operation(operation: Operation, anchor: str, site: DocumentationSite) -> Iterator[Block]:
    again = (Badge("idempotent", "plain"),) if operation.idempotent else ()
    marks = (pattern_badge(pattern) for pattern in patterns(operation))
    yield Heading(3, join_inlines(((InlineCode(operation.name),), *marks, again), SPACE), anchor)
    yield DeclarationBlock(tuple(_signature(operation, site)))
    yield from parse_prose(operation.doc)


def _signature(operation: Operation, site: DocumentationSite) -> Iterator[Inlines]:
    """One line if it is short, else one line per parameter."""
    result = site.type_link(operation.result) if operation.result else inline_code("void")
    params = [_param(p, site) for p in operation.inputs]
    params += [(InlineCode("out "), *_param(p, site)) for p in operation.outputs]
    throws = join_inlines(map(site.declaration_link, operation.throws), InlineCode(", "))
    tail = (InlineCode(" throws "), *throws, InlineCode(";")) if throws else (InlineCode(";"),)
    head = (*result, InlineCode(f" {operation.name}("))
    whole = (*head, *join_inlines(params, InlineCode(", ")), InlineCode(")"), *tail)
    if sum(len(part.text) for part in whole) <= MAX_SIGNATURE_LENGTH:
        yield whole
        return
    yield head
    for i, words in enumerate(params, 1):
        yield (InlineCode("    "), *words, *((InlineCode(","),) if i < len(params) else ()))
    yield (InlineCode(")"), *tail)


def _param(param: Param, site: DocumentationSite) -> Inlines:
    unit = f" [{param.unit}]" if param.unit else ""
    return (*site.type_link(param.type), InlineCode(f" {param.name}{unit}"))


def operation_links(
    interface: Interface, site: DocumentationSite
) -> list[tuple[Operation, Inlines]]:
    """The operations of an interface, and their names as links."""
    page = site.target(interface).page
    anchors = operation_anchors(interface)
    return [
        (operation, inline_code(operation.name, Target(page, anchor)))
        for operation, anchor in zip(interface.operations, anchors, strict=True)
    ]


def operation_anchors(interface: Interface) -> list[str]:
    """The anchors of the operations in the interface's page."""
    names = AnchorNames()
    return [names.claim(f"operation.{operation.name}") for operation in interface.operations]


def patterns(operation: Operation) -> tuple[Pattern, ...]:
    """The pattern of an operation, or both patterns of an unmarked one."""
    if operation.pattern is Pattern.UNMARKED:
        return (operation.as_service(), operation.as_topic())
    return (operation.pattern,)


def pattern_badge(pattern: Pattern) -> Inlines:
    """The badge of a pattern."""
    return (Badge(pattern.value, pattern.value),)


def _module(module: Module, site: DocumentationSite) -> Iterator[Block]:
    imports = join_inlines(map(site.link, module.imports))
    yield FactTable(
        (("File", inline_code(module.path.name)), *((("Imports", imports),) if imports else ()))
    )
    yield from parse_prose(module.doc)
    rows = [
        TableRow(
            (
                site.declaration_link(interface),
                join_inlines(w for _, w in operation_links(interface, site)),
                first_sentence(interface.doc),
            )
        )
        for interface in module.interfaces
    ]
    if rows:
        yield Heading(2, plain_text("Interfaces"), "interfaces")
        yield from data_table(
            f"Interfaces of {module.name}", ("interface", "operations", "what it is"), rows
        )
    types = [
        declaration for declaration in module.declarations if not isinstance(declaration, Interface)
    ]
    if types:
        yield Heading(2, plain_text("Types"), "types")
    here = site.with_local_anchors({id(member): type_anchor(member) for member in types})
    for member in types:
        yield from type_blocks(member, type_anchor(member), here)
