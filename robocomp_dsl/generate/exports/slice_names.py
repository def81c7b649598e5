"""Names that ZeroC's Slice compilers accept (Ice 3.7 manual, "Lexical Rules" and "Modules").

In: names of IDSL. Out: identifiers that `slice2py` and its relatives accept, unescaped; `escaped`
is for printing. Within one scope, Slice names are case-insensitive.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import report_renamed
from robocomp_dsl.model.interface import Interface, Module, Operation, Param
from robocomp_dsl.model.types import Declaration, Enum, Enumerator, ExceptionType, Field, Struct
from robocomp_dsl.model.types import Sequence as SequenceType
from robocomp_dsl.name_table import NameTable
from robocomp_dsl.slice_identifiers import valid_name

NamedElement = Declaration | Operation | Param | Field | Enumerator

KEYWORDS = frozenset(
    (
        *("bool", "byte", "class", "const", "dictionary", "double", "enum", "exception"),
        *("extends", "false", "float", "idempotent", "implements", "int", "interface", "local"),
        *("long", "module", "optional", "out", "sequence", "short", "string", "struct", "tag"),
        *("throws", "true", "void"),
    )
)


def escape_keyword(name: str) -> str:
    """`name` as it is printed: a keyword gets a backslash."""
    return f"\\{name}" if name in KEYWORDS else name


def members(declaration: Declaration) -> Iterator[NamedElement]:
    """All named elements of a declaration, including parameters."""
    match declaration:
        case Struct() | ExceptionType():
            yield from declaration.fields
        case Enum():
            yield from declaration.enumerators
        case Interface():
            for operation in declaration.operations:
                yield operation
                yield from (*operation.inputs, *operation.outputs)


class SliceNames:
    """The Slice names of all exported modules and their elements."""

    def __init__(self, modules: Sequence[Module], report: Report) -> None:
        self._report = report
        self._scopes: dict[str, NameTable] = {}
        self._names: dict[NamedElement, str] = {}
        self._modules: dict[str, str] = {}
        outer = NameTable(valid_name)
        inner = self._scopes
        for module in modules:
            if module.name not in self._modules:
                self._modules[module.name] = outer.claim(module.name)[0]
                if self._modules[module.name] != module.name:
                    self._report_renamed(module, self._modules[module.name])
                inner[module.name] = NameTable(valid_name, taken=(self._modules[module.name],))
            self._claim(module.declarations, inner[module.name])
            for declaration in module.declarations:
                self._claim_members(declaration)

    def module(self, name: str) -> str:
        """The name of a module."""
        return self._modules[name]

    def __getitem__(self, element: NamedElement) -> str:
        return self._names[element]

    def _claim_members(self, declaration: Declaration) -> None:
        match declaration:
            case Struct() | ExceptionType():
                self._claim(declaration.fields, NameTable(valid_name))
                self._claim_arrays(declaration)
            case Enum():
                self._claim(declaration.enumerators, NameTable(valid_name))
            case Interface():
                self._claim(
                    declaration.operations, NameTable(valid_name, taken=(self._names[declaration],))
                )
                for operation in declaration.operations:
                    self._claim((*operation.inputs, *operation.outputs), NameTable(valid_name))

    def _claim_arrays(self, declaration: Struct | ExceptionType) -> None:
        """Name the arrays of fields after the fields."""
        for field in declaration.fields:
            if isinstance(field.type, SequenceType) and field.type.is_anonymous:
                name = f"{self._names[declaration]}_{self._names[field]}"
                self._names[field.type] = self._scopes[declaration.module].claim(name)[0]

    def _claim(self, all_: Iterable[NamedElement], scope: NameTable) -> None:
        # Valid names are claimed first, so that they stay unchanged.
        for element in sorted(all_, key=lambda named: valid_name(named.name) != named.name):
            self._names[element], _ = scope.claim(element.name)
            if self._names[element] != element.name:
                self._report_renamed(element, self._names[element])

    def _report_renamed(self, element: NamedElement | Module, new: str) -> None:
        why = "in Slice it equals another name"
        if valid_name(element.name) != element.name:
            why = "the name is not valid in Slice"
        report_renamed(self._report, element.span, element.name, new, why)
