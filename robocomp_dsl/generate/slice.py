"""Interfaces as Slice, for everything that speaks Ice without this project.

In: modules. Out: one `.ice` file for each IDSL file. What goes over the wire is what RoboComp's own
`.ice` files say: the order of fields, parameters and enumerators, names of modules, interfaces,
operations and exceptions. Parameters that go out stand behind the others, as Slice wants them; on
the wire they do so anyway.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes, literals
from robocomp_dsl.generate.export import by_file, closure
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.slice_names import SliceNames, escaped, members
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.interface import Interface, Module, Operation
from robocomp_dsl.model.types import (
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


def files(modules: Sequence[Module], alone: bool, report: Report) -> Iterator[OutputFile]:
    """The `.ice` file of `modules`, and unless `alone` those of the imports, imports first."""
    everything = closure(modules)
    names = SliceNames(everything, report)
    for path, inside in by_file(everything).items():
        if not alone or path == modules[0].path:
            yield OutputFile(_file_name(path), _file(path, inside, names, report))


def _file_name(path: Path) -> str:
    return f"{path.stem}.ice"


def _file(path: Path, modules: Sequence[Module], names: SliceNames, report: Report) -> str:
    imported = dict.fromkeys(one.path for module in modules for one in module.imports)
    text = render(
        "slice/interface.ice",
        source=literals.printable(path.name),
        guard=f"{re.sub(r'[^0-9A-Za-z]', '_', path.stem).upper()}_ICE",
        includes=[_file_name(one) for one in imported if one != path],
        modules=[
            {
                "name": escaped(names.module(one.name)),
                "doc": comment(one.doc),
                "declarations": [
                    _Printer(one, names, report).declaration(d) for d in declared_first(one)
                ],
            }
            for one in modules
        ],
    )
    # Slice wants to be told that names have underscores.
    return f'[["underscore"]]\n{text}' if "_" in re.sub("(?m)^#.*", "", text) else text


def declared_first(module: Module) -> list[Declaration]:
    """The declarations in their order, but each behind those of the module that it uses."""
    placed: dict[Declaration, None] = {}

    def place(one: Declaration) -> None:
        for used in _used(one):
            if isinstance(used, Declaration) and used in own and used not in placed:
                place(used)
        placed[one] = None

    own = frozenset(module.declarations)
    for one in module.declarations:
        if one not in placed:
            place(one)
    return list(placed)


def _used(one: Declaration) -> Iterator[Type | ExceptionType]:
    match one:
        case Struct() | ExceptionType():
            yield from (field.type for field in one.fields)
        case SequenceType():
            yield one.element
        case Dictionary():
            yield from (one.key, one.value)
        case Interface():
            for operation in one.operations:
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

    def declaration(self, one: Declaration) -> str:
        """One declaration with its comment, indented once."""
        name = escaped(self._names[one])
        self._inside = frozenset(self._names[each].lower() for each in members(one))
        match one:
            case Enum():
                text = f"enum {name}{_block(self._enumerators(one))}"
            case Struct():
                text = f"struct {name}{_block(self._struct(one))}"
            case ExceptionType():
                text = f"exception {name}{_block(self._fields(one.fields))}"
            case SequenceType():
                text = f"sequence<{self._type(one.element)}> {name};"
            case Dictionary():
                text = f"dictionary<{self._type(one.key)}, {self._type(one.value)}> {name};"
            case Interface():
                text = f"interface {name}{_block(self._operations(one))}"
            case _:
                raise TypeError(f"{one.qualified} cannot be exported")
        return "".join(
            f"{STEP}{row}\n" if row else "\n" for row in [*comment(one.doc), *text.split("\n")]
        )

    def _type(self, one: Type | ExceptionType) -> str:
        if isinstance(one, Primitive):
            return one.name
        # A short name that a member has too would, says Slice, change its meaning on the way.
        hidden = self._names[one].lower() in self._inside
        if hidden or one.module != self._module.name:
            return self._path(one)
        return escaped(self._names[one])

    def _path(self, one: Declaration) -> str:
        # From the outermost place, because a declaration of ours may be called as that module.
        # Within a path Slice takes keywords for names, and a backslash for a part of the name.
        return f"::{self._names.module(one.module)}::{self._names[one]}"

    def _enumerators(self, one: Enum) -> Iterator[str]:
        plain = [e.value for e in one.enumerators] == list(range(len(one.enumerators)))
        last = len(one.enumerators) - 1
        for number, each in enumerate(one.enumerators):
            if each.value < 0:
                said = f"`{each.name}` is {each.value}, but Slice has no negative enumerators"
                self._report.add(codes.NOT_EXPORTABLE, each.span, said)
            yield from comment(each.doc)
            value = "" if plain else f" = {each.value}"
            yield f"{escaped(self._names[each])}{value}{',' if number < last else ''}"

    def _struct(self, one: Struct) -> Iterator[str]:
        if not one.fields:
            said = f"`{one.name}` gets a field, because Slice has no struct without one"
            self._report.add(codes.RESHAPED_IN_EXPORT, one.span, said)
            yield from comment("Means nothing: Slice has no struct without fields.")
            yield "bool unused;"
        yield from self._fields(one.fields)

    def _fields(self, all_: Iterable[Field]) -> Iterator[str]:
        for one in all_:
            yield from comment(one.doc, one.unit)
            yield f"{self._type(one.type)} {escaped(self._names[one])}{self._default(one)};"

    def _default(self, one: Field) -> str:
        match one.default:
            case None:
                return ""
            case bool():
                return f" = {str(one.default).lower()}"
            case str() if isinstance(one.type, Enum):
                chosen = next(e for e in one.type.enumerators if e.name == one.default)
                return f" = {self._path(one.type)}::{self._names[chosen]}"
            case str():
                return f" = {_quoted(one.default)}"
        return f" = {one.default!r}"

    def _operations(self, one: Interface) -> Iterator[str]:
        for each in one.operations:
            units = [f"{p.name} in {p.unit}" for p in (*each.inputs, *each.outputs) if p.unit]
            said = f"Units: {', '.join(units)}." if units else ""
            yield from comment("\n".join(part for part in (each.doc, said) if part))
            yield self._operation(each)

    def _operation(self, one: Operation) -> str:
        result = self._type(one.result) if one.result else "void"
        parameters = [
            *(f"{self._type(p.type)} {escaped(self._names[p])}" for p in one.inputs),
            *(f"out {self._type(p.type)} {escaped(self._names[p])}" for p in one.outputs),
        ]
        thrown = ", ".join(self._type(each) for each in one.throws)
        return (
            f"{'idempotent ' if one.idempotent else ''}{result} {escaped(self._names[one])}"
            f"({', '.join(parameters)}){f' throws {thrown}' if thrown else ''};"
        )


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


def _quoted(text: str) -> str:
    plain = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t")
    # Octal, because it ends after three digits whatever follows.
    return '"' + "".join(c if " " <= c <= "~" else _code(c) for c in plain) + '"'


def _code(character: str) -> str:
    number = ord(character)
    if number < 0x80:
        return f"\\{number:03o}"
    return f"\\u{number:04x}" if number < 0x10000 else f"\\U{number:08x}"
