"""Types and exceptions as blocks of a page.

In: declarations of a module. Out: blocks; the name of a type is a link to its description.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.nodes import (
    Block,
    DeclarationBlock,
    Heading,
    InlineCode,
    Inlines,
    PlainText,
    TableRow,
    data_table,
    inline_code,
)
from robocomp_dsl.generate.doc.prose import flatten_doc, parse_prose
from robocomp_dsl.generate.doc.site import DocumentationSite
from robocomp_dsl.model.interface import Interface, Operation
from robocomp_dsl.model.types import (
    Declaration,
    Dictionary,
    Enum,
    ExceptionType,
    Field,
    Literal,
    Primitive,
    Sequence,
    Struct,
    Type,
)

KINDS: dict[type[Declaration], str] = {
    Struct: "struct",
    ExceptionType: "exception",
    Enum: "enum",
    Sequence: "sequence",
    Dictionary: "dictionary",
}


def type_blocks(declaration: Declaration, anchor: str, site: DocumentationSite) -> Iterator[Block]:
    """A heading, the kind, the doc comment and the parts; empty for an interface."""
    yield Heading(
        3, (PlainText(f"{KINDS[type(declaration)]} "), InlineCode(declaration.name)), anchor
    )
    if isinstance(declaration, Sequence | Dictionary):
        yield DeclarationBlock((container_declaration(declaration, site),))
    yield from parse_prose(declaration.doc)
    if isinstance(declaration, Struct | ExceptionType):
        head = ("field", "type", "unit", "default", "what it is")
        yield from data_table(
            f"Fields of {declaration.name}", head, [_field(f, site) for f in declaration.fields]
        )
        if isinstance(declaration, Struct) and declaration.constants:
            yield from _constants(declaration)
    elif isinstance(declaration, Enum):
        rows = [
            TableRow((inline_code(e.name), inline_code(str(e.value)), flatten_doc(e.doc)))
            for e in declaration.enumerators
        ]
        yield from data_table(
            f"Values of {declaration.name}", ("name", "value", "what it is"), rows
        )


def _constants(struct: Struct) -> Iterator[Block]:
    """The table of the constants of a ROS message."""
    rows = [
        TableRow(
            (
                inline_code(c.name),
                inline_code(c.type.name),
                inline_code(format_default(c.value, c.type)),
                flatten_doc(c.doc),
            )
        )
        for c in struct.constants
    ]
    head = ("constant", "type", "value", "what it is")
    yield from data_table(f"Constants of {struct.name}", head, rows)


def _default(field: Field) -> str:
    if field.items and isinstance(field.type, Sequence):
        items = [format_default(item, field.type.element) for item in field.items]
        return f"[{', '.join(items)}]"
    return format_default(field.default, field.type)


def container_declaration(declaration: Sequence | Dictionary, site: DocumentationSite) -> Inlines:
    """`sequence<T> name;`, with its bound if there is one."""
    bound = declaration.bound if isinstance(declaration, Sequence) else 0
    inner = (
        site.type_link(declaration.element)
        if isinstance(declaration, Sequence)
        else (
            *site.type_link(declaration.key),
            InlineCode(", "),
            *site.type_link(declaration.value),
        )
    )
    return (
        InlineCode(f"{KINDS[type(declaration)]}<"),
        *inner,
        InlineCode(f"{f', {bound}' if bound else ''}> {declaration.name};"),
    )


def format_default(value: Literal | None, type_: Type) -> str:
    """A default in IDSL syntax; empty for none."""
    if value is None:
        return ""
    if isinstance(value, str):
        return literals.quoted(value) if isinstance(type_, Primitive) else value
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _field(field: Field, site: DocumentationSite) -> TableRow:
    default = inline_code(_default(field))
    doc = flatten_doc(field.doc)
    return TableRow(
        (inline_code(field.name), site.type_link(field.type), inline_code(field.unit), default, doc)
    )


def referenced_types(interface: Interface) -> tuple[Declaration, ...]:
    """All types and exceptions of the operations, direct and indirect, in order of first use."""
    types: dict[int, Declaration] = {}
    todo: list[Type | ExceptionType] = [
        type_
        for operation in reversed(interface.operations)
        for type_ in reversed(_operation_types(operation))
    ]
    while todo:
        referenced = todo.pop()
        if isinstance(referenced, Sequence) and referenced.is_anonymous:
            todo.append(referenced.element)
        elif not isinstance(referenced, Primitive) and id(referenced) not in types:
            types[id(referenced)] = referenced
            todo.extend(reversed(list(_member_types(referenced))))
    return tuple(types.values())


def _operation_types(operation: Operation) -> list[Type | ExceptionType]:
    result = [operation.result] if operation.result else []
    return [*result, *(p.type for p in (*operation.inputs, *operation.outputs)), *operation.throws]


def _member_types(type_: Type | ExceptionType) -> Iterable[Type]:
    match type_:
        case Struct() | ExceptionType():
            return [f.type for f in type_.fields]
        case Sequence():
            return [type_.element]
        case Dictionary():
            return [type_.key, type_.value]
    return []
