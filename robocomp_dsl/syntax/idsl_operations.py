"""IDSL: operations and their parameters, and the types they use.

In: what the parser recognised of an operation. Out: nodes of `ast_idsl`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Name, Node, Number, QualifiedName, Unit
from robocomp_dsl.syntax.ast_idsl import Operation, Param
from robocomp_dsl.syntax.builder import Builder, only

PATTERNS = ("command", "query", "publish")
_SEQUENCES = ("vector", "list", "array", "set", "deque", "sequence")


class Template(Node):
    """`vector<X>`, `map<K, V>`: no form of IDSL, but of the languages it is read beside."""

    types: tuple[QualifiedName, ...]

    @property
    def is_sequence(self) -> bool:
        """Whether a `sequence` says the same."""
        return len(self.types) == 1 and self.container.text.lower() in _SEQUENCES

    @property
    def container(self) -> Span:
        """The word in front of the `<`."""
        length = len(self.span.text.partition("<")[0].rstrip())
        return self.span.part(self.span.start, self.span.start + length)


class Throws(Node):
    """The exceptions of an operation."""

    types: tuple[QualifiedName, ...]


class Operations(Builder):
    """The part of the IDSL builder that is about operations."""

    def qualified(self, span: Span, first: Name, second: Name | None) -> QualifiedName:
        """`Name` or `Module::Name`."""
        return QualifiedName(span, second, first) if second else QualifiedName(span, first)

    def template(self, span: Span, *children: Any) -> Template:
        """`vector<X>`; what to say of it depends on where it stands."""
        return Template(span, only(QualifiedName, children))

    def inline_template(self, span: Span, template: Template) -> QualifiedName:
        """A template in the place of a type, which must have a name of its own."""
        written = re.sub(r"\s+", "", span.text)
        inside = f"<{', '.join(one.text for one in template.types)}>"
        right = f"sequence{inside}" if template.is_sequence else f"dictionary{inside}"
        self.say(
            codes.TEMPLATE_TYPE,
            span,
            f"`{written}` cannot be used in place",
            label="a sequence or dictionary needs a name",
            help=f"declare `{right} SomeName;` in front and use `SomeName` here",
        )
        return template.types[0]

    def pure(self, span: Span, _value: Number) -> None:
        """`= 0` behind a method, as in C++."""
        self.say(
            codes.PURE_VIRTUAL,
            span,
            "an operation is not marked with `= 0`",
            label="this means nothing in IDSL",
            fix=self.rewrite("delete it", span),
        )

    def throws(self, span: Span, *children: Any) -> Throws:
        """`throws A, B`."""
        return Throws(span, tuple(self.without_comma(children)))

    def param(self, span: Span, *children: Any) -> Param:
        """`out Type name [unit]`; a missing name is made up when the operation is known."""
        at = next(i for i, child in enumerate(children) if isinstance(child, QualifiedName))
        kind, name, unit = children[at : at + 3]
        for direction in children[:at]:
            if direction.text == "idempotent":
                self._meaningless(direction, "a parameter")
        out = any(direction.text == "out" for direction in children[:at])
        return Param(span, kind, name or Name(kind.span, ""), out, unit)

    def operation(self, span: Span, *children: Any) -> Operation:
        """One operation with its marks, result, parameters and exceptions."""
        result = next(child for child in children if isinstance(child, QualifiedName))
        at = children.index(result)
        returned = None if result.text == "void" else result
        return self._operation(span, children[:at], returned, children[at + 1 :])

    def operation_without_result(self, span: Span, *children: Any) -> Operation:
        """`flush();`: what it returns was forgotten."""
        at = next(
            i
            for i, child in enumerate(children)
            if isinstance(child, Name) and child.text not in ("idempotent", "out")
        )
        name = children[at].span
        self.say(
            codes.NO_RESULT,
            name,
            f"`{name.text}` does not say what it returns",
            label="read as `void`",
            fix=self.findings.fix("return nothing", (name.start, name.start, "void ")),
        )
        return self._operation(span, children[:at], None, children[at:])

    def _operation(
        self, span: Span, marks: Any, result: QualifiedName | None, children: Any
    ) -> Operation:
        name, *rest = self._without_inner_comma(children)
        pattern: Name | None = None
        for mark in marks:
            if isinstance(mark, Unit):
                pattern = self.once(pattern, self._pattern(mark), "the pattern") or pattern
            elif mark.text == "out":
                self._meaningless(mark, "an operation")
        throws = only(Throws, rest)
        return Operation(
            span,
            name,
            result,
            self._params(only(Param, rest)),
            throws[0].types if throws else (),
            any(isinstance(m, Name) and m.text == "idempotent" for m in marks),
            pattern,
            self.doc(span),
        )

    def _pattern(self, mark: Unit) -> Name:
        start = mark.span.start + mark.span.text.index(mark.text)
        word = Name(mark.span.part(start, start + len(mark.text)), mark.text)
        self.vocabulary(word, PATTERNS, "pattern")
        return word

    def _params(self, params: tuple[Param, ...]) -> tuple[Param, ...]:
        """With names for those that have none, and a word on what is unusual."""
        if len(params) == 1 and not params[0].name.text and params[0].type.text == "void":
            self.say(
                codes.UNNAMED_PARAMETER,
                params[0].span,
                "no parameters are written `()`",
                fix=self.rewrite("delete `void`", params[0].span),
            )
            return ()
        named = tuple(self._named(number, one) for number, one in enumerate(params, start=1))
        self._out_last(named)
        return named

    def _named(self, number: int, param: Param) -> Param:
        if param.name.text:
            return param
        name, at = f"arg{number}", param.type.span.end
        self.say(
            codes.UNNAMED_PARAMETER,
            param.span,
            "this parameter has no name",
            label=f"called `{name}`",
            fix=self.findings.fix(f"call it `{name}`", (at, at, f" {name}")),
        )
        return Param(param.span, param.type, Name(param.type.span, name), param.out, param.unit)

    def _out_last(self, params: tuple[Param, ...]) -> None:
        """Slice and C++ callers expect the `out` parameters behind the others."""
        ordered = sorted(params, key=lambda param: param.out)
        if ordered == list(params):
            return
        late = next(p for i, p in enumerate(params) if not p.out and params[i - 1].out and i)
        moves = zip(params, ordered, strict=True)
        edits = ((old.span.start, old.span.end, new.span.text) for old, new in moves)
        self.say(
            codes.OUT_FIRST,
            late.span,
            f"`{late.name.text}` stands behind an `out` parameter",
            fix=self.findings.fix("move the `out` parameters to the end", *edits),
        )

    def _meaningless(self, word: Name, where: str) -> None:
        self.say(
            codes.MEANINGLESS_WORD,
            word.span,
            f"`{word.text}` means nothing in front of {where}",
            label="ignored",
            fix=self.rewrite("delete it", word.span),
        )

    def _without_inner_comma(self, children: Iterable[Any]) -> list[Any]:
        """The comma behind the last parameter may be followed by more."""
        kept = [child for child in children if child is not None]
        at = next((i for i, c in enumerate(kept) if isinstance(c, Name) and c.text == ","), -1)
        if at < 0:
            return kept
        return [*self.without_comma(kept[: at + 1]), *kept[at + 1 :]]
