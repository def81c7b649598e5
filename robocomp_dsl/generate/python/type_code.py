"""One IDSL type as Python source: a class or an alias.

In: a declaration and the names of all types. Out: `TypeCode`, plain data for the template of
`interfaces.py`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import docs, literals, names
from robocomp_dsl.generate.python.layout import INNER, WIDTH
from robocomp_dsl.generate.python.python_types import (
    PythonTypes,
    column_of,
    field_names,
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
)
from robocomp_dsl.record import ValueRecord


class FieldCode(ValueRecord):
    """One field of a struct or exception. Its doc comment is above it or on the same line."""

    name: str
    type: str
    default: str
    above: tuple[str, ...]
    behind: str


class ConstantCode(ValueRecord):
    """A constant of a ROS message, with the comment lines above it."""

    name: str
    value: str
    comments: tuple[str, ...]


class EnumeratorCode(ValueRecord):
    """One value of an enumeration, with the comment lines above it."""

    name: str
    value: int
    comments: tuple[str, ...]


class ColumnCode(ValueRecord):
    """The attribute for one field of all elements of an array: its name and definition."""

    name: str
    definition: str


class TypeCode(ValueRecord):
    """One type. `kind`: struct, enum, array, alias; fields that a kind lacks are empty.

    `base` is the base class of a struct, the element of an array, the target of an alias. `type_id`
    is the name of a struct in its IDSL file. `rename` is empty if all attributes have their wire
    names, `units` if no field has a unit. `is_hidden`: a field has the type's name.
    """

    kind: str
    name: str
    base: str = ""
    doc: str = ""
    comments: tuple[str, ...] = ()
    is_hidden: bool = False
    type_id: str = ""
    definition: str = ""
    rename: str = ""
    units: str = ""
    constants: tuple[ConstantCode, ...] = ()
    fields: tuple[FieldCode, ...] = ()
    values: tuple[EnumeratorCode, ...] = ()
    columns: tuple[ColumnCode, ...] = ()


def type_code(declaration: Declaration, types: PythonTypes) -> TypeCode:
    """The class or the alias of one type."""
    name = types.names[declaration]
    is_hidden = name in types.hidden
    comments = tuple(literals.comment(declaration.doc))
    doc = literals.docstring(declaration.doc, INNER, f"{declaration.qualified}.")
    match declaration:
        case Struct() | ExceptionType():
            return _struct(name, declaration, types, is_hidden=is_hidden)
        case Enum():
            values = tuple(
                EnumeratorCode(types.enumerator(e), e.value, tuple(literals.comment(e.doc, INNER)))
                for e in declaration.enumerators
            )
            return TypeCode("enum", name, doc=doc, is_hidden=is_hidden, values=values)
        case Dictionary():
            pair = ", ".join(map(types.declared, (declaration.key, declaration.value)))
            return TypeCode("alias", name, f"dict[{pair}]", "", comments, is_hidden)
        case Sequence():
            if element := record_element(declaration):
                columns = tuple(_columns(element, types))
                base = types.names[element]
                return TypeCode("array", name, base, doc, (), is_hidden, columns=columns)
            base = types.list_or_array(declaration)
            return TypeCode("alias", name, base, "", comments, is_hidden)
    raise TypeError(f"{declaration.qualified} is no type")


def _struct(
    name: str, struct: Struct | ExceptionType, types: PythonTypes, *, is_hidden: bool
) -> TypeCode:
    attributes = field_names(struct)
    pairs = list(zip(attributes, struct.fields, strict=True))
    renamed = [
        f"{literals.quoted(attribute)}: {literals.quoted(field.name)}"
        for attribute, field in pairs
        if attribute != field.name
    ]
    return TypeCode(
        "struct",
        name,
        "rt.Struct" if isinstance(struct, Struct) else "rt.DeclaredError",
        literals.docstring(struct.doc, INNER, f"{struct.qualified}."),
        is_hidden=is_hidden,
        type_id=literals.quoted(struct.type_id),
        definition=_definition(struct),
        rename=f"{{{', '.join(renamed)}}}" if renamed else "",
        units=_units(struct),
        constants=tuple(_constants(struct, attributes)),
        fields=tuple(_field(attribute, field, struct, types) for attribute, field in pairs),
    )


def _definition(struct: Struct | ExceptionType) -> str:
    """The text of a ROS definition as a literal; "" if the fields say everything."""
    text = struct.definition if isinstance(struct, Struct) else ""
    return literals.python_string(text) if text else ""


def _units(struct: Struct | ExceptionType) -> str:
    """`{"name": unit}` of the fields; ROS hashes its types itself, without units."""
    is_ros = isinstance(struct, Struct) and struct.ros_name
    return literals.unit_table(() if is_ros else struct.fields)


def _constants(struct: Struct | ExceptionType, attributes: Iterable[str]) -> Iterator[ConstantCode]:
    """The constants of a ROS message; their names differ from those of the fields."""
    constants = struct.constants if isinstance(struct, Struct) else ()
    reserved = names.STRUCT_MEMBERS | set(attributes)
    constant_names = names.unique([constant.name for constant in constants], reserved)
    for name, constant in zip(constant_names, constants, strict=True):
        comments = tuple(literals.comment(constant.doc, INNER))
        yield ConstantCode(name, literals.python_value(constant.value), comments)


def _field(
    name: str, field: Field, inside: Struct | ExceptionType, types: PythonTypes
) -> FieldCode:
    type_, default = types.declared(field.type, inside), types.default(field, inside)
    doc = docs.of_field(field)
    behind = f"  # {literals.printable(doc)}" if doc else ""
    if len(f"{INNER}{name}: {type_} = {default}{behind}") <= WIDTH:
        return FieldCode(name, type_, default, (), behind)
    rows = literals.wrapped(literals.printable(doc), WIDTH - len(f"{INNER}# "))
    return FieldCode(name, type_, default, tuple(f"{INNER}# {row}" for row in rows if row), "")


def _columns(element: Struct, types: PythonTypes) -> list[ColumnCode]:
    attributes = field_names(element)
    # The columns share a scope with the list's own methods; fields do not.
    column_names = names.unique(
        attributes, names.ARRAY_MEMBERS | names.ANNOTATION | set(types.names.values())
    )
    columns = []
    for name, attribute, field in zip(column_names, attributes, element.fields, strict=True):
        arguments = [] if name == attribute else [literals.quoted(attribute)]
        column_class = column_of(field.type)
        if isinstance(field.type, Struct):
            column_class, arguments = "rt.NestedColumn", [types.names[field.type], *arguments]
        columns.append(ColumnCode(name, f"{column_class}({', '.join(arguments)})"))
    return columns
