"""IDSL: from text to the tree of `ast_idsl`.

In: a source. Out: the tree, and findings about its form.
"""

from __future__ import annotations

from typing import Any, ClassVar

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import ast_idsl as ast
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Bool, Import, Literal, Name, Number, QualifiedName, Unit
from robocomp_dsl.syntax.builder import only
from robocomp_dsl.syntax.idsl_operations import Operations, Template
from robocomp_dsl.syntax.read import read

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
    file: ast.File = read("idsl", IdslBuilder, source, report)
    return file


class IdslBuilder(Operations):
    """Makes the nodes of `ast_idsl`."""

    ITEMS: ClassVar = {
        "file_item": "`import` or `module`",
        "module_item": "a declaration (`struct`, `enum`, `sequence`, `interface`, …)",
        "field_item": "a field",
        "interface_item": "an operation",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file. Declarations from outside of a module are counted to the last one."""
        modules = only(ast.Module, items)
        for another in modules[1:]:
            self.say(
                codes.SEVERAL_MODULES,
                another.name.span,
                "a file has one module",
                help="give each module a file of its own, so that others can import it",
            )
        strays = tuple(item for item in items if isinstance(item, _DECLARATIONS))
        if strays and modules:
            last = modules[-1]
            spans = [last.span, *(one.span for one in strays)]
            around = last.span.part(min(s.start for s in spans), max(s.end for s in spans))
            joined = ast.Module(around, last.name, last.declarations + strays, last.doc)
            modules = (*modules[:-1], joined)
        return ast.File(span, only(Import, items), modules, self.finished("module"))

    def module(self, span: Span, name: Name, *items: Any) -> ast.Module:
        """`module Name { … };`."""
        self.has_block = True
        made = tuple(item for item in items if isinstance(item, _DECLARATIONS))
        return ast.Module(span, name, made, self.doc(span))

    def outside_module(self, span: Span, item: Any) -> Any:
        """A declaration beside the module."""
        if item is not None:
            self.say(
                codes.MISPLACED,
                self._head(span),
                "a declaration belongs into a module",
                help="write `module RoboCompName { … };` around it",
            )
        return item

    def outside_interface(self, span: Span, _operation: ast.Operation) -> None:
        """An operation beside the interfaces."""
        self.say(codes.MISPLACED, self._head(span), "an operation belongs into an interface")

    def outside_struct(self, span: Span, *_parts: Any) -> None:
        """A field beside the structs."""
        self.say(
            codes.MISPLACED,
            span,
            f"the field `{span.text.rstrip('; ')}` belongs into a struct",
            help="IDSL has no variables; write `struct Name { … };` around it",
        )

    def _head(self, span: Span) -> Span:
        """The first line of it."""
        return span.part(span.start, span.start + len(span.text.partition("\n")[0]))

    def extends(self, span: Span, *_types: Any) -> None:
        """`extends Other`, which Slice has and IDSL has not."""
        self.say(
            codes.INHERITANCE,
            span,
            "IDSL has no inheritance",
            label="nothing is inherited",
            help="repeat the members here, or let the component implement both interfaces",
            fix=self.rewrite("delete it", span),
        )

    def struct(self, span: Span, name: Name, _extends: None, *items: Any) -> ast.Struct:
        """`struct Name { … };`."""
        return ast.Struct(span, name, only(ast.Field, items), self.doc(span))

    def exception(self, span: Span, name: Name, _extends: None, *items: Any) -> ast.ExceptionDecl:
        """`exception Name { … };`."""
        return ast.ExceptionDecl(span, name, only(ast.Field, items), self.doc(span))

    def field(
        self,
        span: Span,
        kind: QualifiedName,
        name: Name,
        unit: Unit | None,
        default: tuple[Literal, Unit | None] | None,
    ) -> ast.Field:
        """`type name [unit] = default [unit];`."""
        value, second = default or (None, None)
        return ast.Field(span, kind, name, value, unit or second, self.doc(span))

    def default(self, _span: Span, value: Any, unit: Unit | None) -> tuple[Literal, Unit | None]:
        """`= value`; the module of a qualified enumerator says nothing new."""
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
        return tuple(self.without_comma(children))

    def enumerator(self, span: Span, name: Name, value: Number | None) -> ast.Enumerator:
        """`A` or `A = 2`."""
        return ast.Enumerator(span, name, value, self.doc(span))

    def sequence(self, span: Span, element: QualifiedName, name: Name) -> ast.Sequence:
        """`sequence<element> Name;`."""
        return ast.Sequence(span, name, element, self.doc(span))

    def dictionary(
        self, span: Span, key: QualifiedName, value: QualifiedName, name: Name
    ) -> ast.Dictionary:
        """`dictionary<key, value> Name;`."""
        return ast.Dictionary(span, name, key, value, self.doc(span))

    def template_declaration(
        self, span: Span, template: Template, name: Name
    ) -> ast.Sequence | ast.Dictionary:
        """`vector<X> Name;`: a sequence or dictionary under the name of another language."""
        right = "sequence" if len(template.types) == 1 else "dictionary"
        word = template.container
        self.say(
            codes.TEMPLATE_TYPE,
            word,
            f"IDSL has no `{word.text}`",
            label=f"write `{right}`",
            fix=self.rewrite(f"write `{right}`", word, right),
        )
        if right == "sequence":
            return ast.Sequence(span, name, template.types[0], self.doc(span))
        return ast.Dictionary(span, name, template.types[0], template.types[1], self.doc(span))

    def interface(self, span: Span, name: Name, _extends: None, *items: Any) -> ast.Interface:
        """`interface Name { … };`."""
        return ast.Interface(span, name, only(ast.Operation, items), self.doc(span))
