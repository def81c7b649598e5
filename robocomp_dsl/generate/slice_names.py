"""Names as ZeroC's Slice compilers take them (Ice 3.7 manual, "Lexical Rules" and "Modules").

In: names of IDSL. Out: identifiers that `slice2py` and its relatives accept, unescaped; `escaped`
is for printing. Slice does not tell capital from small letters within one place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import Spelling, report_renamed
from robocomp_dsl.model.interface import Interface, Module, Operation, Param
from robocomp_dsl.model.types import Declaration, Enum, Enumerator, ExceptionType, Field, Struct

Named = Declaration | Operation | Param | Field | Enumerator

KEYWORDS = frozenset(
    (
        *("bool", "byte", "class", "const", "dictionary", "double", "enum", "exception"),
        *("extends", "false", "float", "idempotent", "implements", "int", "interface", "local"),
        *("long", "module", "optional", "out", "sequence", "short", "string", "struct", "tag"),
        *("throws", "true", "void"),
    )
)
_RESERVED_END = re.compile(r"(?:Prx|Ptr|Helper|Holder)$")
_BUILT_IN = ("LocalObject", "Object", "Value")
"""Types of Slice: even escaped, a type of ours with such a name is taken for them in places."""


def escaped(name: str) -> str:
    """`name` as it is printed: a keyword gets a backslash."""
    return f"\\{name}" if name in KEYWORDS else name


def fit(name: str) -> str:
    """`name` without what Slice forbids: outer and double underscores, reserved ends and starts."""
    plain = re.sub("_+", "_", name).strip("_") or "n"
    if plain[0].isdigit() or plain[:3].lower() == "ice":
        plain = f"n_{plain}"
    return f"{plain}1" if _RESERVED_END.search(plain) or plain in _BUILT_IN else plain


def members(one: Declaration) -> Iterator[Named]:
    """Everything that has a name within a declaration, parameters too."""
    match one:
        case Struct() | ExceptionType():
            yield from one.fields
        case Enum():
            yield from one.enumerators
        case Interface():
            for operation in one.operations:
                yield operation
                yield from (*operation.inputs, *operation.outputs)


class SliceNames:
    """The names of all modules of an export and of everything in them."""

    def __init__(self, modules: Sequence[Module], report: Report) -> None:
        self._report = report
        self._of: dict[Named, str] = {}
        self._modules: dict[str, str] = {}
        outer = Spelling(fit)
        inner: dict[str, Spelling] = {}
        for one in modules:
            if one.name not in self._modules:
                self._modules[one.name] = outer.claim(one.name)[0]
                if self._modules[one.name] != one.name:
                    self._tell(one, self._modules[one.name])
                inner[one.name] = Spelling(fit, taken=(self._modules[one.name],))
            self._claim(one.declarations, inner[one.name])
            for declaration in one.declarations:
                self._inside(declaration)

    def module(self, name: str) -> str:
        """The name of a module."""
        return self._modules[name]

    def __getitem__(self, one: Named) -> str:
        return self._of[one]

    def _inside(self, one: Declaration) -> None:
        match one:
            case Struct() | ExceptionType():
                self._claim(one.fields, Spelling(fit))
            case Enum():
                self._claim(one.enumerators, Spelling(fit))
            case Interface():
                self._claim(one.operations, Spelling(fit, taken=(self._of[one],)))
                for operation in one.operations:
                    self._claim((*operation.inputs, *operation.outputs), Spelling(fit))

    def _claim(self, all_: Iterable[Named], scope: Spelling) -> None:
        # A name that Slice takes as it is keeps it, whoever comes first.
        for one in sorted(all_, key=lambda named: fit(named.name) != named.name):
            self._of[one], _ = scope.claim(one.name)
            if self._of[one] != one.name:
                self._tell(one, self._of[one])

    def _tell(self, one: Named | Module, new: str) -> None:
        why = "Slice takes it for the same as another name"
        if fit(one.name) != one.name:
            why = "Slice does not allow the name"
        report_renamed(self._report, one.span, one.name, new, why)
