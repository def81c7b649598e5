"""Interfaces as Slice, for Ice programs that do not use this project.

In: modules. Out: one `.ice` file for each IDSL file. The wire format equals that of RoboComp's own
`.ice` files: the order of fields, parameters and enumerators, and the names of modules, interfaces,
operations and exceptions. Output parameters follow the inputs, as Slice requires and as they are
encoded. Slice has no arrays, no bounds and no unsigned integers: it gets sequences and integers
with the same bytes, and the comments tell the limits.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes, literals
from robocomp_dsl.generate.export import modules_by_file, transitive_modules
from robocomp_dsl.generate.exports.slice_names import SliceNames, escape_keyword, members
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.interface import Interface, Module, Operation
from robocomp_dsl.model.types import (
    INT8,
    OCTET,
    UINT16,
    UINT32,
    UINT64,
    Declaration,
    Dictionary,
    Enum,
    ExceptionType,
    Field,
    Primitive,
    Struct,
    Type,
)
from robocomp_dsl.model.types import (
    Sequence as SequenceType,
)

STEP = "    "
_SAME_SIZE = {INT8: "byte", OCTET: "byte", UINT16: "short", UINT32: "int", UINT64: "long"}
"""Slice types with the same bytes: Slice has no unsigned types."""
_UNSIGNED = (UINT16, UINT32, UINT64)


def files(modules: Sequence[Module], alone: bool, report: Report) -> Iterator[OutputFile]:
    """The `.ice` file of `modules`, and unless `alone` those of the imports, imports first."""
    everything = transitive_modules(modules)
    names = SliceNames(everything, report)
    for path, inside in modules_by_file(everything).items():
        if not alone or path == modules[0].path:
            yield OutputFile(_file_name(path, inside), _file(path, inside, names, report))


def _file_name(path: Path, modules: Iterable[Module]) -> str:
    """ROS packages may have the same names, so the file of a definition is named after both."""
    package = next((f"{module.name}_" for module in modules if module.is_ros), "")
    return f"{package}{path.stem}.ice"


def _file(path: Path, modules: Sequence[Module], names: SliceNames, report: Report) -> str:
    imports = modules_by_file(imported for module in modules for imported in module.imports)
    text = render(
        "slice/interface.ice",
        source=literals.printable(path.name),
        guard=f"{re.sub(r'[^0-9A-Za-z]', '_', path.stem).upper()}_ICE",
        includes=[_file_name(file, inside) for file, inside in imports.items() if file != path],
        modules=[
            {
                "name": escape_keyword(names.module(module.name)),
                "doc": comment(module.doc),
                "declarations": [
                    _Printer(module, names, report).declaration(d) for d in dependency_order(module)
                ],
            }
            for module in modules
        ],
    )
    # Slice needs this declaration for names with underscores.
    return f'[["underscore"]]\n{text}' if "_" in re.sub("(?m)^#.*", "", text) else text


def dependency_order(module: Module) -> list[Declaration]:
    """The declarations in their order, but each after the declarations that it uses."""
    placed: dict[Declaration, None] = {}

    def place(declaration: Declaration) -> None:
        for used in _referenced_types(declaration):
            if isinstance(used, Declaration) and used in own and used not in placed:
                place(used)
        placed[declaration] = None

    own = frozenset(module.declarations)
    for declaration in module.declarations:
        if declaration not in placed:
            place(declaration)
    return list(placed)


def _referenced_types(declaration: Declaration) -> Iterator[Type | ExceptionType]:
    match declaration:
        case Struct() | ExceptionType():
            yield from (field.type for field in declaration.fields)
        case SequenceType():
            yield declaration.element
        case Dictionary():
            yield from (declaration.key, declaration.value)
        case Interface():
            for operation in declaration.operations:
                yield from (p.type for p in (*operation.inputs, *operation.outputs))
                yield from operation.throws
                if operation.result:
                    yield operation.result


class _Printer:
    """Declarations of one module as Slice."""

    def __init__(self, module: Module, names: SliceNames, report: Report) -> None:
        self._module = module
        self._names = names
        self._report = report
        self._inside: frozenset[str] = frozenset()

    def declaration(self, declaration: Declaration) -> str:
        """One declaration with its comment, indented once."""
        name, doc = escape_keyword(self._names[declaration]), declaration.doc
        self._inside = frozenset(self._names[each].lower() for each in members(declaration))
        match declaration:
            case Enum():
                text = f"enum {name}{_block(self._enumerators(declaration))}"
            case Struct():
                arrays = "".join(f"{row}\n" for row in self._arrays(declaration))
                text = f"{arrays}struct {name}{_block(self._struct(declaration))}"
            case ExceptionType():
                arrays = "".join(f"{row}\n" for row in self._arrays(declaration))
                text = f"{arrays}exception {name}{_block(self._fields(declaration.fields))}"
            case SequenceType():
                text = f"sequence<{self._type(declaration.element)}> {name};"
                doc = "\n".join(part for part in (doc, _sequence_limits(declaration)) if part)
            case Dictionary():
                key, value = self._type(declaration.key), self._type(declaration.value)
                text = f"dictionary<{key}, {value}> {name};"
            case Interface():
                text = f"interface {name}{_block(self._operations(declaration))}"
            case _:
                raise TypeError(f"{declaration.qualified} cannot be exported")
        return "".join(
            f"{STEP}{row}\n" if row else "\n" for row in [*comment(doc), *text.split("\n")]
        )

    def _type(self, type_: Type | ExceptionType) -> str:
        if isinstance(type_, Primitive):
            return "string" if type_.is_text else _SAME_SIZE.get(type_, type_.name)
        if isinstance(type_, SequenceType) and type_.is_anonymous:
            return self._names[type_]
        # Slice rejects a short name that is also the name of a member.
        hidden = self._names[type_].lower() in self._inside
        if hidden or type_.module != self._module.name:
            return self._path(type_)
        return escape_keyword(self._names[type_])

    def _path(self, declaration: Declaration) -> str:
        # An absolute path, because a declaration may have the same name as the module.
        # In a path, Slice accepts keywords as names and takes a backslash as part of the name.
        return f"::{self._names.module(declaration.module)}::{self._names[declaration]}"

    def _enumerators(self, enum: Enum) -> Iterator[str]:
        plain = [e.value for e in enum.enumerators] == list(range(len(enum.enumerators)))
        last = len(enum.enumerators) - 1
        for number, each in enumerate(enum.enumerators):
            if each.value < 0:
                message = f"`{each.name}` is {each.value}, but Slice has no negative enumerators"
                self._report.add(codes.NOT_EXPORTABLE, each.span, message)
            yield from comment(each.doc)
            value = "" if plain else f" = {each.value}"
            yield f"{escape_keyword(self._names[each])}{value}{',' if number < last else ''}"

    def _struct(self, struct: Struct) -> Iterator[str]:
        if not struct.fields:
            message = f"`{struct.name}` gets a field, because Slice has no empty structs"
            self._report.add(codes.RESHAPED_IN_EXPORT, struct.span, message)
            yield from comment("Unused: Slice has no struct without fields.")
            yield "bool unused;"
        yield from self._fields(struct.fields)

    def _arrays(self, struct: Struct | ExceptionType) -> Iterator[str]:
        """The arrays of the fields, as sequences: Slice has no arrays."""
        for field in struct.fields:
            if isinstance(field.type, SequenceType) and field.type.is_anonymous:
                name = self._names[field.type]
                yield f"sequence<{self._type(field.type.element)}> {name};"

    def _fields(self, all_: Iterable[Field]) -> Iterator[str]:
        for field in all_:
            yield from comment(_with_limits(field), field.unit)
            name = escape_keyword(self._names[field])
            yield f"{self._type(field.type)} {name}{self._default(field)};"

    def _default(self, field: Field) -> str:
        if field.type in _SAME_SIZE:  # the default may be out of the range of the Slice type
            return ""
        match field.default:
            case None:
                return ""
            case bool():
                return f" = {str(field.default).lower()}"
            case str() if isinstance(field.type, Enum):
                chosen = next(e for e in field.type.enumerators if e.name == field.default)
                return f" = {self._path(field.type)}::{self._names[chosen]}"
            case str():
                return f" = {_string_literal(field.default)}"
        return f" = {field.default!r}"

    def _operations(self, interface: Interface) -> Iterator[str]:
        for each in interface.operations:
            bits = [f"{n} has the bits of an {t.name}." for n, t in _unsigned_values(each)]
            units = [f"{p.name} in {p.unit}" for p in (*each.inputs, *each.outputs) if p.unit]
            message = f"Units: {', '.join(units)}." if units else ""
            yield from comment("\n".join(part for part in (each.doc, message, *bits) if part))
            yield self._operation(each)

    def _operation(self, operation: Operation) -> str:
        result = self._type(operation.result) if operation.result else "void"
        parameters = [
            *(f"{self._type(p.type)} {escape_keyword(self._names[p])}" for p in operation.inputs),
            *(
                f"out {self._type(p.type)} {escape_keyword(self._names[p])}"
                for p in operation.outputs
            ),
        ]
        thrown = ", ".join(self._type(each) for each in operation.throws)
        return (
            f"{'idempotent ' if operation.idempotent else ''}{result} "
            f"{escape_keyword(self._names[operation])}"
            f"({', '.join(parameters)}){f' throws {thrown}' if thrown else ''};"
        )


def _unsigned_values(operation: Operation) -> Iterator[tuple[str, Primitive]]:
    """Parameters and result that have no sign, with their types."""
    params = ((f"`{p.name}`", p.type) for p in (*operation.inputs, *operation.outputs))
    for name, type_ in (*params, ("The result", operation.result)):
        if isinstance(type_, Primitive) and type_ in _UNSIGNED:
            yield name, type_


def _with_limits(field: Field) -> str:
    """The comment of a field, with what Slice cannot express of its type."""
    return "\n".join(part for part in (field.doc, _limits(field.type)) if part)


def _limits(type_: Type) -> str:
    """What is missing in the Slice type of `type_`, as a sentence."""
    if isinstance(type_, SequenceType) and type_.is_anonymous:
        return _sequence_limits(type_)
    if isinstance(type_, Primitive) and type_ in _UNSIGNED:
        return f"The bits of an {type_.name}."
    return ""


def _sequence_limits(type_: SequenceType) -> str:
    count = f"Exactly {type_.size} elements." if type_.size else ""
    bound = f"At most {type_.bound} elements." if type_.bound else ""
    return " ".join(part for part in (count, bound, _limits(type_.element)) if part)


def _block(rows: Iterable[str]) -> str:
    inside = "".join(f"\n{STEP}{row}" for row in rows)
    return f"\n{{{inside}\n}};"


def comment(doc: str, unit: str = "") -> list[str]:
    """A doc comment as lines of Slice, none for an empty one."""
    rows = literals.lines(doc)
    if unit:
        rows = [*rows[:-1], f"{rows[-1] if rows else ''} [{literals.printable(unit)}]".strip()]
    rows = [row.replace("*/", "* /").replace("/*", "/ *") for row in rows]
    if len(rows) < 2:
        return [f"/** {row} */" for row in rows]
    return [f"/** {rows[0]}", *(f" * {row}".rstrip() for row in rows[1:]), " */"]


def _string_literal(text: str) -> str:
    plain = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t")
    # Octal escapes have exactly three digits, so any character may follow.
    return '"' + "".join(c if " " <= c <= "~" else _escape(c) for c in plain) + '"'


def _escape(character: str) -> str:
    number = ord(character)
    if number < 0x80:
        return f"\\{number:03o}"
    return f"\\u{number:04x}" if number < 0x10000 else f"\\U{number:08x}"
