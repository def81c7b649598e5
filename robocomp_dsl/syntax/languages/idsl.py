"""IDSL: builds the tree of `ast.idsl`.

In: a source. Out: the tree and syntax diagnostics.
"""

from __future__ import annotations

from typing import Any, ClassVar

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Bool, Import, Literal, Name, Number, QualifiedName, Unit
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.languages.builder import of_kind
from robocomp_dsl.syntax.languages.idsl_operations import OperationsBuilder, TemplateType
from robocomp_dsl.syntax.languages.parse_source import parse_source

_DECLARATIONS = (
    ast.Struct,
    ast.ExceptionDecl,
    ast.Enum,
    ast.Sequence,
    ast.Dictionary,
    ast.Interface,
)


def parse(source: Source, report: Report) -> ast.File:
    """The tree of an IDSL file."""
    file: ast.File = parse_source("idsl", IdslBuilder, source, report)
    return file


class IdslBuilder(OperationsBuilder):
    """Builds the nodes of `ast.idsl`."""

    ITEM_NAMES: ClassVar = {
        "file_item": "`import` or `module`",
        "module_item": "a declaration (`struct`, `enum`, `sequence`, `interface`, …)",
        "field_item": "a field",
        "interface_item": "an operation",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file. Declarations outside a module are added to the last module."""
        modules = of_kind(ast.Module, items)
        for another in modules[1:]:
            self.report(
                legacy_codes.SEVERAL_MODULES,
                another.name.span,
                "a file should contain one module",
                help="move each module to its own file so that other files can import it",
            )
        strays = tuple(item for item in items if isinstance(item, _DECLARATIONS))
        if strays and modules:
            last = modules[-1]
            spans = [last.span, *(stray.span for stray in strays)]
            covering = last.span.subspan(min(s.start for s in spans), max(s.end for s in spans))
            joined = ast.Module(covering, last.name, last.declarations + strays, last.doc)
            modules = (*modules[:-1], joined)
        return ast.File(span, of_kind(Import, items), modules, self.is_complete("module"))

    def module(self, span: Span, name: Name, *items: Any) -> ast.Module:
        """`module Name { … };`."""
        self.has_block = True
        declarations = tuple(item for item in items if isinstance(item, _DECLARATIONS))
        return ast.Module(span, name, declarations, self.doc(span))

    def outside_module(self, span: Span, item: Any) -> Any:
        """A declaration outside the module."""
        if item is not None:
            self.report(
                syntax_codes.MISPLACED,
                self._head(span),
                "a declaration belongs in a module",
                help="write `module RoboCompName { … };` around it",
            )
        return item

    def outside_interface(self, span: Span, _operation: ast.Operation) -> None:
        """An operation outside an interface."""
        self.report(
            syntax_codes.MISPLACED, self._head(span), "an operation belongs in an interface"
        )

    def outside_struct(self, span: Span, *_parts: Any) -> None:
        """A field outside a struct."""
        self.report(
            syntax_codes.MISPLACED,
            span,
            f"the field `{span.text.rstrip('; ')}` belongs in a struct",
            help="IDSL has no variables; write `struct Name { … };` around it",
        )

    def _head(self, span: Span) -> Span:
        """The first line of `span`."""
        return span.subspan(span.start, span.start + len(span.text.partition("\n")[0]))

    def extends(self, span: Span, *_types: Any) -> None:
        """`extends Other`, which Slice has and IDSL does not."""
        self.report(
            syntax_codes.INHERITANCE,
            span,
            "IDSL has no inheritance",
            label="nothing is inherited",
            help="repeat the members here, or let the component implement both interfaces",
            fix=self.replace_fix("delete it", span),
        )

    def struct(self, span: Span, name: Name, _extends: None, *items: Any) -> ast.Struct:
        """`struct Name { … };`."""
        return ast.Struct(span, name, of_kind(ast.Field, items), self.doc(span))

    def exception(self, span: Span, name: Name, _extends: None, *items: Any) -> ast.ExceptionDecl:
        """`exception Name { … };`."""
        return ast.ExceptionDecl(span, name, of_kind(ast.Field, items), self.doc(span))

    def field(
        self,
        span: Span,
        *parts: Any,
    ) -> ast.Field:
        """`type name[size] [unit] = default [unit];`."""
        if isinstance(parts[0], tuple):  # `unsigned name`, which was reported
            parts = (*parts[0], *parts[1:])
        kind, name, *brackets, default = parts
        value, second = default or (None, None)
        array, unit = self.array_and_unit([*brackets, *of_kind(Unit, [second])])
        if array and value:
            self.without_default(array, name, value)
            value = None
        return ast.Field(span, kind, name, value, unit, self.doc(span), array)

    def default(self, _span: Span, value: Any, unit: Unit | None) -> tuple[Literal, Unit | None]:
        """`= value`; the module of a qualified enumerator is redundant."""
        if not isinstance(value, QualifiedName):
            return value, unit
        if value.text in ("true", "false"):
            return Bool(value.span, value.text == "true"), unit
        return Name(value.span, value.name.text), unit

    def enum(self, span: Span, name: Name, body: tuple[ast.Enumerator, ...] | None) -> ast.Enum:
        """`enum Name { A, B };`."""
        return ast.Enum(span, name, body or (), self.doc(span))

    def enumerators(self, _span: Span, *children: Any) -> tuple[ast.Enumerator, ...]:
        """The names of an enumeration."""
        return tuple(self.without_trailing_comma(children))

    def enumerator(self, span: Span, name: Name, value: Number | None) -> ast.Enumerator:
        """`A` or `A = 2`."""
        return ast.Enumerator(span, name, value, self.doc(span))

    def sequence(
        self, span: Span, element: QualifiedName, bound: int | None, name: Name
    ) -> ast.Sequence:
        """`sequence<element> Name;` or `sequence<element, bound> Name;`."""
        return ast.Sequence(span, name, element, self.doc(span), bound=bound or 0)

    def dictionary(
        self, span: Span, key: QualifiedName, value: QualifiedName, name: Name
    ) -> ast.Dictionary:
        """`dictionary<key, value> Name;`."""
        return ast.Dictionary(span, name, key, value, self.doc(span))

    def template_declaration(
        self, span: Span, template: TemplateType, name: Name
    ) -> ast.Sequence | ast.Dictionary:
        """`vector<X> Name;`: a sequence or dictionary under the name of another language."""
        right = "sequence" if len(template.types) == 1 else "dictionary"
        word = template.container
        self.report(
            syntax_codes.TEMPLATE_TYPE,
            word,
            f"IDSL has no `{word.text}`",
            label=f"write `{right}`",
            fix=self.replace_fix(f"write `{right}`", word, right),
        )
        if right == "sequence":
            return ast.Sequence(span, name, template.types[0], self.doc(span))
        return ast.Dictionary(span, name, template.types[0], template.types[1], self.doc(span))

    def interface(self, span: Span, name: Name, _extends: None, *items: Any) -> ast.Interface:
        """`interface Name { … };`."""
        return ast.Interface(span, name, of_kind(ast.Operation, items), self.doc(span))
