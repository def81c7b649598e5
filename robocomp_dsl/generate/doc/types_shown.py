"""Types and exceptions as blocks of a page.

In: declarations of a module. Out: blocks; every name of a type leads to where it is described.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.prose import inline_doc, prose
from robocomp_dsl.generate.doc.site import Site
from robocomp_dsl.generate.doc.words import (
    Block,
    Code,
    Heading,
    Row,
    Signature,
    Text,
    Words,
    code,
    table,
)
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


def type_blocks(one: Declaration, anchor: str, site: Site) -> Iterator[Block]:
    """A heading, what it is, its doc comment and its parts. An interface gives nothing."""
    yield Heading(3, (Text(f"{KINDS[type(one)]} "), Code(one.name)), anchor)
    if isinstance(one, Sequence | Dictionary):
        yield Signature((container(one, site),))
    yield from prose(one.doc)
    if isinstance(one, Struct | ExceptionType):
        head = ("field", "type", "unit", "default", "what it is")
        yield from table(f"Fields of {one.name}", head, [_field(f, site) for f in one.fields])
    elif isinstance(one, Enum):
        rows = [Row((code(e.name), code(str(e.value)), inline_doc(e.doc))) for e in one.enumerators]
        yield from table(f"Values of {one.name}", ("name", "value", "what it is"), rows)


def container(one: Sequence | Dictionary, site: Site) -> Words:
    """`sequence<T> name;`."""
    inner = (
        site.type(one.element)
        if isinstance(one, Sequence)
        else (*site.type(one.key), Code(", "), *site.type(one.value))
    )
    return (Code(f"{KINDS[type(one)]}<"), *inner, Code(f"> {one.name};"))


def literal(value: Literal | None, type_: Type) -> str:
    """A default as IDSL has it; empty for none."""
    if value is None:
        return ""
    if isinstance(value, str):
        return literals.quoted(value) if isinstance(type_, Primitive) else value
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _field(one: Field, site: Site) -> Row:
    default = code(literal(one.default, one.type))
    doc = inline_doc(one.doc)
    return Row((code(one.name), site.type(one.type), code(one.unit), default, doc))


def types_behind(interface: Interface) -> tuple[Declaration, ...]:
    """Types and exceptions that its operations speak of, directly or not, as first met."""
    found: dict[int, Declaration] = {}
    todo: list[Type | ExceptionType] = [
        type_ for one in reversed(interface.operations) for type_ in reversed(_spoken_of(one))
    ]
    while todo:
        one = todo.pop()
        if not isinstance(one, Primitive) and id(one) not in found:
            found[id(one)] = one
            todo.extend(reversed(list(_parts(one))))
    return tuple(found.values())


def _spoken_of(one: Operation) -> list[Type | ExceptionType]:
    result = [one.result] if one.result else []
    return [*result, *(p.type for p in (*one.inputs, *one.outputs)), *one.throws]


def _parts(one: Type | ExceptionType) -> Iterable[Type]:
    match one:
        case Struct() | ExceptionType():
            return [f.type for f in one.fields]
        case Sequence():
            return [one.element]
        case Dictionary():
            return [one.key, one.value]
    return []
