"""IDSL: builds operations, their parameters and types.

In: the rules that the parser recognised in an operation. Out: nodes of `ast.idsl`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Name, Node, Number, QualifiedName, Unit
from robocomp_dsl.syntax.ast.idsl import Operation, Param
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.languages.builder import of_kind
from robocomp_dsl.syntax.languages.idsl_lengths import LengthsBuilder

PATTERNS = ("command", "query", "publish")
_SEQUENCES = ("vector", "list", "array", "set", "deque", "sequence")


class TemplateType(Node):
    """`vector<X>`, `map<K, V>`: container syntax of other languages, reported as an error."""

    types: tuple[QualifiedName, ...]
    bound: int = 0

    @property
    def is_sequence(self) -> bool:
        """Whether `sequence` is the IDSL equivalent."""
        return len(self.types) == 1 and self.container.text.lower() in _SEQUENCES

    @property
    def container(self) -> Span:
        """The name before the `<`."""
        length = len(self.span.text.partition("<")[0].rstrip())
        return self.span.subspan(self.span.start, self.span.start + length)


class ThrowsClause(Node):
    """The exceptions of an operation."""

    types: tuple[QualifiedName, ...]


class OperationsBuilder(LengthsBuilder):
    """The part of the IDSL builder for operations."""

    def qualified(self, span: Span, first: Name, second: Name | None) -> QualifiedName:
        """`Name` or `Module::Name`."""
        return QualifiedName(span, second, first) if second else QualifiedName(span, first)

    def template(self, span: Span, *children: Any) -> TemplateType:
        """`vector<X>`; the caller reports it."""
        bound = next((child for child in children if isinstance(child, int)), 0)
        return TemplateType(span, of_kind(QualifiedName, children), bound)

    def inline_template(self, span: Span, template: TemplateType) -> QualifiedName:
        """A template used as a type: IDSL containers are declared with a name."""
        written = re.sub(r"\s+", "", span.text)
        arguments = [type_.text for type_ in template.types]
        if template.bound:
            arguments.append(str(template.bound))
        inside = f"<{', '.join(arguments)}>"
        right = f"sequence{inside}" if template.is_sequence else f"dictionary{inside}"
        self.report(
            syntax_codes.TEMPLATE_TYPE,
            span,
            f"`{written}` cannot be used as a type",
            label="declare a named sequence or dictionary",
            help=f"declare `{right} SomeName;` and use `SomeName` here",
        )
        return template.types[0]

    def pure(self, span: Span, _value: Number) -> None:
        """`= 0` after a method, as in C++."""
        self.report(
            legacy_codes.PURE_VIRTUAL,
            span,
            "`= 0` after an operation is ignored",
            label="ignored",
            fix=self.replace_fix("delete it", span),
        )

    def throws(self, span: Span, *children: Any) -> ThrowsClause:
        """`throws A, B`."""
        return ThrowsClause(span, tuple(self.without_trailing_comma(children)))

    def param(self, span: Span, *children: Any) -> Param:
        """`out Type name [unit]`; a missing name is generated when the operation is built."""
        index = _index_of_type(children)
        kind, name, *brackets = children[index:]
        out = False
        for direction in children[:index]:
            if direction.text == "idempotent":
                self._meaningless(direction, "a parameter")
            out = out or direction.text == "out"
        unit = self.scalar_unit(name.text if name else kind.text, brackets) if brackets else None
        return Param(span, kind, name or Name(kind.span, ""), out, unit)

    def operation(self, span: Span, *children: Any) -> Operation:
        """One operation with its pattern, flags, result, parameters and exceptions."""
        index = _index_of_type(children)
        result = children[index]
        returned = None if result.text == "void" else result
        return self._operation(span, children[:index], returned, children[index + 1 :])

    def operation_without_result(self, span: Span, *children: Any) -> Operation:
        """`flush();`: the return type is missing."""
        index = next(
            i
            for i, child in enumerate(children)
            if isinstance(child, Name) and child.text not in ("idempotent", "out")
        )
        name = children[index].span
        self.report(
            legacy_codes.NO_RESULT,
            name,
            f"`{name.text}` has no return type",
            label="read as `void`",
            fix=self.findings.fix("return nothing", (name.start, name.start, "void ")),
        )
        return self._operation(span, children[:index], None, children[index:])

    def _operation(
        self, span: Span, marks: Any, result: QualifiedName | None, children: Any
    ) -> Operation:
        name, *rest = children
        params = [child for child in rest if isinstance(child, Param)]
        throws = of_kind(ThrowsClause, rest)
        self._report_comma(children)
        pattern: Name | None = None
        idempotent = False
        for mark in marks:
            if isinstance(mark, Unit):
                pattern = self.first_of(pattern, self._pattern(mark), "the pattern") or pattern
            elif mark.text == "out":
                self._meaningless(mark, "an operation")
            else:
                idempotent = True
        return Operation(
            span,
            name,
            result,
            self._params(params),
            throws[0].types if throws else (),
            idempotent,
            pattern,
            self.doc(span),
        )

    def _pattern(self, mark: Unit) -> Name:
        word = Name(self.inside(mark), mark.text)
        self.check_choice(word, PATTERNS, "pattern")
        return word

    def _params(self, params: list[Param]) -> tuple[Param, ...]:
        """The parameters, with generated names for unnamed ones; `params` is changed."""
        if len(params) == 1 and not params[0].name.text and params[0].type.text == "void":
            self.report(
                legacy_codes.UNNAMED_PARAMETER,
                params[0].span,
                "an empty parameter list is written `()`",
                fix=self.replace_fix("delete `void`", params[0].span),
            )
            return ()
        is_out = False
        for index, param in enumerate(params):
            if not param.name.text:
                params[index] = self._named(index + 1, param)
        for param in params:
            if is_out and not param.out:
                self._report_order(params)
                break
            is_out = param.out
        return tuple(params)

    def _named(self, number: int, param: Param) -> Param:
        name, end = f"arg{number}", param.type.span.end
        self.report(
            legacy_codes.UNNAMED_PARAMETER,
            param.span,
            "this parameter has no name",
            label=f"called `{name}`",
            fix=self.findings.fix(f"call it `{name}`", (end, end, f" {name}")),
        )
        return Param(param.span, param.type, Name(param.type.span, name), param.out, param.unit)

    def _report_order(self, params: list[Param]) -> None:
        """Report `out` parameters before inputs: Slice and C++ expect them last."""
        ordered = sorted(params, key=lambda param: param.out)
        late = next(p for i, p in enumerate(params) if not p.out and params[i - 1].out and i)
        moves = zip(params, ordered, strict=True)
        edits = ((old.span.start, old.span.end, new.span.text) for old, new in moves)
        self.report(
            legacy_codes.OUT_FIRST,
            late.span,
            f"`{late.name.text}` follows an `out` parameter",
            fix=self.findings.fix("move the `out` parameters to the end", *edits),
        )

    def _meaningless(self, word: Name, where: str) -> None:
        self.report(
            legacy_codes.MEANINGLESS_KEYWORD,
            word.span,
            f"`{word.text}` has no effect before {where}",
            label="ignored",
            fix=self.replace_fix("delete it", word.span),
        )

    def _report_comma(self, children: Sequence[Any]) -> None:
        """Report a comma after the last parameter; more items may follow it."""
        for index, child in enumerate(children):
            if isinstance(child, Name) and child.text == ",":
                self.without_trailing_comma(children[: index + 1])
                return


def _index_of_type(children: Sequence[Any]) -> int:
    """Where the type is: behind the marks."""
    index = 0
    while not isinstance(children[index], QualifiedName):
        index += 1
    return index
