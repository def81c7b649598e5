"""Names of types in an IDSL module.

In: a name as written. Out: what it means, or None after a finding (or where one was made before).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TypeVar

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.visible import Visible
from robocomp_dsl.diagnostics import Code, Fix, Note, Report, nearest
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.syntax.ast_base import QualifiedName

Kind = TypeVar("Kind", bound=types.Declaration)
Own = Callable[[QualifiedName], types.Declaration | None]

_DATA = (types.Struct, types.Enum, types.Sequence, types.Dictionary)
_FOREIGN = {
    "boolean": "bool",
    "char": "byte",
    "uint8": "byte",
    "int16": "short",
    "int32": "int",
    "unsigned": "int",
    "int64": "long",
    "real": "float",
    "float32": "float",
    "float64": "double",
    "str": "string",
}
"""What other languages call our built-in types."""

MOST_GUESSES = 20
"""How many different unknown names of a module get a suggestion: each costs a search, and who has
more of them has another problem than spelling."""


class TypeNames:
    """The names that one module can use. `own` gives a declaration of the module itself."""

    def __init__(
        self, module: str, own_names: Collection[str], own: Own, visible: Visible, report: Report
    ) -> None:
        self._module = module
        self._own_names = own_names
        self._own = own
        self._visible = visible
        self._report = report
        self._guesses: dict[str, str | None] = {}

    def data(self, name: QualifiedName) -> types.Type | None:
        """The data type called `name`."""
        if name.module is None and name.name.text in types.PRIMITIVES:
            return types.PRIMITIVES[name.name.text]
        found = self._declaration(name, _DATA)
        if isinstance(found, _DATA):
            return found
        if found is not None:
            self._report_kind(name, found, "a data type", codes.NOT_A_TYPE)
        return None

    def exception(self, name: QualifiedName) -> types.ExceptionType | None:
        """The exception called `name`."""
        if name.module is None and name.name.text in types.PRIMITIVES:
            self._report.add(
                codes.NOT_AN_EXCEPTION, name.span, f"`{name.text}` is a built-in type, no exception"
            )
            return None
        found = self._declaration(name, (types.ExceptionType,))
        if isinstance(found, types.ExceptionType) or found is None:
            return found
        self._report_kind(name, found, "an exception", codes.NOT_AN_EXCEPTION)
        return None

    def _declaration(
        self, name: QualifiedName, kinds: tuple[type[types.Declaration], ...]
    ) -> types.Declaration | None:
        local = name.module is None or name.module.text == self._module
        if local and name.name.text in self._own_names:
            return self._own(name)
        found = self._visible.find(name, types.Declaration)
        fitting = [one for one in found if isinstance(one, kinds)] or found
        if len(fitting) == 1:
            return fitting[0]
        if fitting:
            self._report_ambiguous(name, fitting)
        else:
            self._report_unknown(name)
        return None

    def _report_kind(
        self, name: QualifiedName, found: types.Declaration, wanted: str, code: Code
    ) -> None:
        what = {types.ExceptionType: "an exception", Interface: "an interface"}
        self._report.add(
            code,
            name.span,
            f"`{name.text}` is {what.get(type(found), 'a data type')}, not {wanted}",
            notes=[Note(found.span, f"`{found.name}` is declared here")],
        )

    def _report_ambiguous(self, name: QualifiedName, found: Sequence[types.Declaration]) -> None:
        choices = list(dict.fromkeys(one.qualified for one in found))
        self._report.add(
            codes.AMBIGUOUS_TYPE,
            name.span,
            f"`{name.text}` can mean {listing(choices)}"
            if len(choices) > 1
            else f"several imported files declare `{choices[0]}`",
            notes=[Note(one.span, f"`{one.qualified}` is declared here") for one in found],
            help="write the module in front of it" if len(choices) > 1 else "import only one",
        )

    def _report_unknown(self, name: QualifiedName) -> None:
        if name.text == "void":
            self._report.add(codes.NOT_A_TYPE, name.span, "`void` can only be a result")
            return
        guess = self._guess(name)
        if self._visible.is_excused(name, guess):
            return
        way_out = "" if guess else "it is built in, declared in this module, or in an imported file"
        fix: Fix | None = replace(name.span, guess) if guess else None
        same_letters = guess is not None and guess.lower() == name.text.lower()
        own = name.module is not None and name.module.text == self._module
        searched = not (same_letters or own) and name.text in self._guesses
        offer = self._visible.importable(name) if searched else None
        if offer is not None:
            guess, fix = None, offer.fix
            way_out = f"{offer.help}, but {offer.is_not} imported"
        self._report.add(
            codes.UNKNOWN_TYPE,
            name.span,
            f"there is no type `{name.text}`",
            label=f"did you mean `{guess}`?" if guess else "",
            help=way_out,
            fix=fix,
        )

    def _guess(self, name: QualifiedName) -> str | None:
        """What was meant, most likely; the same for the same name, and nothing beyond a number."""
        if name.text not in self._guesses:
            if len(self._guesses) >= MOST_GUESSES:
                return None
            self._guesses[name.text] = self._nearest(name)
        return self._guesses[name.text]

    def _nearest(self, name: QualifiedName) -> str | None:
        word = name.name.text
        if name.module is None or name.module.text == "std":
            elsewhere = word.lower().removesuffix("_t")  # as in C and C++
            if elsewhere in _FOREIGN or (name.module and word in types.PRIMITIVES):
                return _FOREIGN.get(elsewhere, word)
        if name.module is None:
            return nearest(word, [*types.PRIMITIVES, *self._own_names, *self._imported()])
        module = name.module.text
        moved = [d for d in self._visible.declarations(types.Declaration) if d.name == word]
        if len(moved) == 1:
            return moved[0].qualified
        if module == self._module:
            near = nearest(word, self._own_names)
        elif module in self._visible.module_names():
            near = nearest(word, self._imported(module))
        else:
            other = nearest(module, [self._module, *self._visible.module_names()])
            return f"{other}::{word}" if other else None
        return f"{module}::{near}" if near else None

    def _imported(self, module: str | None = None) -> list[str]:
        return [d.name for kind in _DATA for d in self._visible.declarations(kind, module)]
