"""Resolves names of types in an IDSL module.

In: a name. Out: the declaration, or None and a diagnostic (unless one was reported before).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TypeVar

from robocomp_dsl.check.codes import types as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import Named
from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Code, Fix, Note, Report, UnknownName, nearest
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import QualifiedName

_NEXT_WORD = re.compile(r"([ \t]+)(\w+)", re.ASCII)
Kind = TypeVar("Kind", bound=types.Declaration)
Own = Callable[[QualifiedName], types.Declaration | None]

_DATA = (types.Struct, types.Enum, types.Sequence, types.Dictionary)
_FOREIGN = {
    "boolean": "bool",
    "char": "byte",
    "int8": "short",
    "uint8": "byte",
    "int16": "short",
    "int32": "int",
    "uint": "unsigned int",
    "uint16": "unsigned short",
    "uint32": "unsigned int",
    "uint64": "unsigned long",
    "ulong": "unsigned long",
    "ushort": "unsigned short",
    "size": "unsigned long",
    "int64": "long",
    "real": "float",
    "float32": "float",
    "float64": "double",
    "str": "string",
}
"""Names of the built-in types in other languages."""

MAX_SUGGESTIONS = 20
"""Number of different unknown names per module that get a suggestion: each costs a search."""


class TypeResolver:
    """The names that one module can use. `own` gives a declaration of the module itself."""

    def __init__(
        self,
        module: str,
        own_names: Mapping[str, Named],
        own: Own,
        visible: ImportScope,
        report: Report,
        primitives: Mapping[str, types.Primitive] = types.PRIMITIVES,
    ) -> None:
        self._primitives = primitives
        self._module = module
        self._own_names = own_names
        self._own = own
        self._visible = visible
        self._report = report
        self._guesses: dict[str, str | None] = {}

    def data(self, name: QualifiedName) -> types.Type | None:
        """The data type called `name`."""
        if name.module is None and name.name.text in self._primitives:
            return self._primitives[name.name.text]
        found = self._declaration(name, (*_DATA, types.Alias))
        if isinstance(found, types.Alias):
            return found.target
        if isinstance(found, _DATA):
            return found
        if found is not None:
            self._report_kind(name, found, "a data type", codes.NOT_A_TYPE)
        return None

    def exception(self, name: QualifiedName) -> types.ExceptionType | None:
        """The exception called `name`."""
        if name.module is None and name.name.text in types.PRIMITIVES:
            self._report.add(
                codes.NOT_AN_EXCEPTION,
                name.span,
                f"`{name.text}` is a built-in type, not an exception",
            )
            return None
        found = self._declaration(name, (types.ExceptionType,))
        if isinstance(found, types.ExceptionType) or found is None:
            return found
        self._report_kind(name, found, "an exception", codes.NOT_AN_EXCEPTION)
        return None

    def interface(self, name: QualifiedName) -> Interface | None:
        """The interface called `name`."""
        found = self._declaration(name, (Interface,))
        if isinstance(found, Interface) or found is None:
            return found
        self._report_kind(name, found, "an interface", codes.NOT_A_TYPE)
        return None

    def _declaration(
        self, name: QualifiedName, kinds: tuple[type[types.Declaration], ...]
    ) -> types.Declaration | None:
        local = name.module is None or name.module.text == self._module
        if local and name.name.text in self._own_names:
            return self._own(name)
        found = self._visible.lookup(name, types.Declaration)
        fitting = [declaration for declaration in found if isinstance(declaration, kinds)] or found
        if len(fitting) == 1:
            return fitting[0]
        if fitting:
            self._report_ambiguous(name, fitting)
        else:
            self._report_unknown(name)
        return None

    def _report_kind(
        self, name: QualifiedName, found: types.Declaration, expected: str, code: Code
    ) -> None:
        what = {types.ExceptionType: "an exception", Interface: "an interface"}
        self._report.add(
            code,
            name.span,
            f"`{name.text}` is {what.get(type(found), 'a data type')}, not {expected}",
            notes=[Note(found.span, f"`{found.name}` is declared here")],
        )

    def _report_ambiguous(self, name: QualifiedName, found: Sequence[types.Declaration]) -> None:
        choices = list(dict.fromkeys(declaration.qualified for declaration in found))
        self._report.add(
            codes.AMBIGUOUS_TYPE,
            name.span,
            f"`{name.text}` is ambiguous: {join_names(choices)}"
            if len(choices) > 1
            else f"several imported files declare `{choices[0]}`",
            notes=[
                Note(declaration.span, f"`{declaration.qualified}` is declared here")
                for declaration in found
            ],
            help="write the module before it" if len(choices) > 1 else "import only one",
        )

    def _report_unknown(self, name: QualifiedName) -> None:
        if name.text == "void":
            self._report.add(codes.NOT_A_TYPE, name.span, "`void` is only allowed as return type")
            return
        if self._report_swapped(name):
            return
        guess = self._guess(name)
        if self._visible.is_follow_on_error(name, guess):
            return
        help_text = "" if guess else "a type is built in, declared in this module, or imported"
        fix: Fix | None = replace_fix(name.span, guess) if guess else None
        same_letters = guess is not None and guess.lower() == name.text.lower()
        own = name.module is not None and name.module.text == self._module
        searched = not (same_letters or own) and name.text in self._guesses
        offer = self._visible.suggest_import(name) if searched else None
        if offer is not None:
            guess, fix = None, offer.fix
            help_text = offer.help
            if not offer.written:
                help_text += f", but {offer.is_not} imported"
        self._report.add(
            codes.UNKNOWN_TYPE,
            name.span,
            f"unknown type `{name.text}`",
            label=f"did you mean `{guess}`?" if guess else "",
            help=help_text,
            fix=fix,
            unknown=UnknownName(name.name.text, self._own_spans if own or not name.module else ()),
        )

    @cached_property
    def _own_spans(self) -> tuple[Span, ...]:
        """The names of the declarations of this module."""
        return tuple(own.name.span for own in self._own_names.values())

    def _report_swapped(self, name: QualifiedName) -> bool:
        """Report `count int`, where the name precedes a built-in type; whether it does."""
        text = name.span.source.text
        following = _NEXT_WORD.match(text, name.span.end)
        if name.module is not None or not following or following[2] not in types.PRIMITIVES:
            return False
        right = f"{following[2]}{following[1]}{name.text}"
        span = name.span.source.span(name.span.start, following.end())
        self._report.add(
            codes.UNKNOWN_TYPE,
            name.span,
            f"unknown type `{name.text}`",
            label=f"the type precedes the name: `{' '.join(right.split())}`",
            fix=replace_fix(span, right),
        )
        return True

    def _guess(self, name: QualifiedName) -> str | None:
        """The closest known name, cached per name; None after `MAX_SUGGESTIONS` names."""
        if name.text not in self._guesses:
            if len(self._guesses) >= MAX_SUGGESTIONS:
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
            built_in = (*types.PRIMITIVES, "void")
            near = nearest(word, [*built_in, *self._own_names, *self._imported()])
            letters = sorted(word)
            return near or next((t for t in built_in if sorted(t) == letters), None)
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
