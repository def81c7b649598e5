"""One IDSL type as Python source: a class or an alias.

In: a declaration and the names of all types. Out: `TypeCode`, plain data for the template of
`generated/interfaces.py`; every text in it is valid Python and broken into lines.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate import docs, layout, literals, names
from robocomp_dsl.generate.layout import BODY, INNER, Item
from robocomp_dsl.generate.python_types import (
    PythonTypes,
    column_of,
    field_names,
    numpy_of,
    record_element,
)
from robocomp_dsl.model.types import (
    Declaration,
    Dictionary,
    Enum,
    ExceptionType,
    Field,
    Sequence,
    Struct,
    Type,
)
from robocomp_dsl.record import Value


class ColumnCode(Value):
    """The property for one field of all elements."""

    definition: str
    statement: str


class TypeCode(Value):
    """One type. `kind`: struct, error, enum, records, alias; what a kind lacks is empty.

    `alias` is a second, private name where a field hides the first one in an `__init__`.
    `names` is empty where all attributes are called as on the wire. `statements` are the lines of
    `__init__`, of the enum's body or of the alias.
    """

    kind: str
    head: str = ""
    doc: str = ""
    alias: str = ""
    slots: str = ""
    names: str = ""
    fields: str = ""
    init: str = ""
    columns: tuple[ColumnCode, ...] = ()
    element: str = ""
    statements: tuple[str, ...] = ()


def type_code(declaration: Declaration, types: PythonTypes) -> TypeCode:
    """The class or the alias of one type."""
    name = types.names[declaration]
    doc = literals.docstring(declaration.doc, INNER, f"{declaration.qualified}.")
    match declaration:
        case Struct() | ExceptionType():
            return _record(name, declaration, types)
        case Enum():
            head = layout.class_head(name, "rt.Enum")
            return TypeCode("enum", head, doc, statements=tuple(_values(declaration, types)))
        case Dictionary():
            return TypeCode("alias", statements=tuple(_dictionary(name, declaration, types)))
        case Sequence():
            if element := record_element(declaration):
                return _records(name, doc, element, types)
            return TypeCode("alias", statements=tuple(_sequence(name, declaration, types)))
    raise TypeError(f"{declaration.qualified} is no type")


def _values(enum: Enum, types: PythonTypes) -> Iterator[str]:
    for one in enum.enumerators:
        yield from literals.comment(one.doc)
        yield f"{types.enumerator(one)} = {one.value}"


def _dictionary(name: str, one: Dictionary, types: PythonTypes) -> Iterator[str]:
    pair = (one.key, one.value)
    written = layout.subscript("dict", *(types.annotation(t) for t in pair))
    made = layout.call("rt.Dictionary", *(types.schema(t) for t in pair))
    yield from literals.comment(one.doc)
    yield layout.statement(f"{name} = ", written)
    yield layout.statement(f"_{name} = ", made)


def _sequence(name: str, one: Sequence, types: PythonTypes) -> Iterator[str]:
    element = types.schema(one.element)
    yield from literals.comment(one.doc)
    if array := numpy_of(one):
        yield f"{name} = {array.alias}"
        yield f"_{name} = rt.Array({element})"
        return
    yield layout.statement(f"{name} = ", layout.subscript("list", types.annotation(one.element)))
    yield layout.statement(f"_{name} = ", layout.call("rt.Sequence", element))


def _record(name: str, one: Struct | ExceptionType, types: PythonTypes) -> TypeCode:
    called = field_names(one)
    doc = literals.docstring(docs.of_record(one, called), INNER)
    schemas = [layout.tuple_of(literals.quoted(f.name), types.schema(f.type)) for f in one.fields]
    parameters: list[Item] = ["self"]
    assignments = []
    for attribute, field in zip(called, one.fields, strict=True):
        parameter, assignment = _field(attribute, field, types)
        parameters.append(parameter)
        assignments.append(assignment)
    slots = layout.tuple_of(*map(literals.quoted, sorted(called, key=layout.natural)))
    wired = layout.statement("_names_ = ", layout.tuple_of(*map(literals.quoted, called)), INNER)
    kind = "struct" if isinstance(one, Struct) else "error"
    return TypeCode(
        kind,
        layout.class_head(name, "rt.Struct" if kind == "struct" else "rt.DeclaredError"),
        doc,
        alias=_alias(name, types),
        slots=layout.statement("__slots__ = ", slots, INNER),
        names="" if list(called) == [f.name for f in one.fields] else wired,
        fields=layout.statement("_fields_ = ", layout.tuple_of(*schemas), INNER),
        init=layout.definition("__init__", parameters, "None") if called else "",
        statements=tuple(assignments),
    )


def _field(name: str, field: Field, types: PythonTypes) -> tuple[str, str]:
    """The parameter of `__init__` and the statement that stores it."""
    zero = types.zero(field.type, field.default)
    hint = types.annotation(field.type)
    if not zero.fresh:
        return f"{name}: {hint} = {zero.text}", layout.assignment(f"self.{name}", name, BODY)
    made = f"_{zero.text}" if zero.text.removesuffix("()") in types.hidden else zero.text
    value = layout.choice(f"self.{name}", made, f"{name} is None", name, BODY)
    return layout.optional(name, hint, BODY), value


def _records(name: str, doc: str, element: Struct, types: PythonTypes) -> TypeCode:
    attributes = field_names(element)
    # The columns share their scope with the list's own methods, the fields do not.
    called = names.unique(
        attributes, names.ARRAY_MEMBERS | names.ANNOTATION | set(types.names.values())
    )
    columns = tuple(
        _column(column, attribute, field.type, types)
        for column, attribute, field in zip(called, attributes, element.fields, strict=True)
    )
    return TypeCode(
        "records",
        layout.class_head(name, layout.subscript("rt.StructArray", types.names[element])),
        doc,
        alias=_alias(name, types),
        element=types.names[element],
        columns=columns,
    )


def _alias(name: str, types: PythonTypes) -> str:
    return f"_{name} = {name}  # a field is called as the type" if name in types.hidden else ""


def _column(name: str, attribute: str, type_: Type, types: PythonTypes) -> ColumnCode:
    reader, hint = "column", column_of(type_)
    if isinstance(type_, Struct):
        reader, hint = "nested", f"rt.StructArray[{types.names[type_]}]"
    made = layout.call(f"self.{reader}", literals.quoted(attribute))
    return ColumnCode(
        layout.definition(name, ("self",), hint), layout.statement("return ", made, BODY)
    )
