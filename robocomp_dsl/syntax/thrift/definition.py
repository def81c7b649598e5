"""Thrift definitions: builds the tree of `ast.idsl`, a module that is named after the file.

In: the text of `motor.thrift`. Out: the tree, with one import for each included file, and syntax
diagnostics. The language is that of yarpidl_thrift: https://www.yarp.it/latest/idl_thrift.html. A
service is an interface, a constant a member of the struct `Constants`. Namespaces are those of
generated C++ and are skipped.
"""

from __future__ import annotations

import re

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Import, Literal, Name, QualifiedName, Text
from robocomp_dsl.syntax.codes import yarp as codes
from robocomp_dsl.syntax.definitions import THRIFT_SUFFIX, module_name
from robocomp_dsl.syntax.thrift.cursor import TOP, Cursor, SyntaxMistake
from robocomp_dsl.syntax.thrift.members import MemberReader
from robocomp_dsl.syntax.thrift.tokens import TEXT, WORD
from robocomp_dsl.syntax.thrift.types import BUILT_IN, TypeReader, read_annotations
from robocomp_dsl.syntax.thrift.values import read_value

CONSTANTS = "Constants"
"""The struct that has the constants of a file."""
_WORD = re.compile(r"\w+", re.ASCII)
_CLASSES = {
    "yarp::conf::float32_t": "float32",
    "yarp::conf::float64_t": "float64",
    "yarp::sig::Vector": "float64[]",
    "yarp::sig::VectorOf<double>": "float64[]",
    "yarp::sig::VectorOf<yarp::conf::float64_t>": "float64[]",
    "yarp::sig::VectorOf<float>": "float32[]",
    "yarp::sig::VectorOf<int>": "int32[]",
}
"""Classes of YARP that definitions name with `yarp.name`, and their layout on the wire."""


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a Thrift definition."""
    return _Builder(source, report).file()


class _Builder:
    """Builds the nodes of one definition."""

    def __init__(self, source: Source, report: Report) -> None:
        self._source = source
        self._cursor = Cursor(source, report)
        self._values: dict[str, Literal] = {}
        self._types = TypeReader(self._cursor, {*_WORD.findall(source.text), CONSTANTS})
        self._members = MemberReader(self._cursor, self._types, self._values)
        self._imports: list[Import] = []
        self._constants: list[ast.Constant] = []
        self._declarations: list[ast.Declaration] = []

    def file(self) -> ast.File:
        """The whole tree."""
        cursor = self._cursor
        if cursor.is_at_end and not cursor.failed:
            span = self._source.file_span
            cursor.report(codes.THRIFT_STATEMENT, span, "the file declares nothing")
        while not cursor.is_at_end:
            start = cursor.token
            try:
                self._statement()
            except SyntaxMistake:
                if cursor.token is start:
                    cursor.next()
                cursor.skip_statement(inside=False)
        size = len(self._source.text)
        span = self._source.span(0, size)
        implicit = self._types.implicit.values()
        declarations = (*self._declarations, *self._struct(), *implicit)
        # Not where the first declaration is: positions identify declarations.
        name = Name(self._source.span(size, size), module_name(self._source.path))
        module = ast.Module(span, name, declarations, origin="thrift")
        return ast.File(span, tuple(self._imports), (module,), not cursor.failed)

    def _struct(self) -> tuple[ast.Struct, ...]:
        """The struct with the constants, if there are some."""
        if not self._constants:
            return ()
        span = self._constants[0].span
        # Its name is where the keyword of the first constant is.
        name = Name(span.subspan(span.start, span.start + len("const")), CONSTANTS)
        whole = span.cover(self._constants[-1].span)
        doc = f"The constants of {self._source.path.name}."
        return (ast.Struct(whole, name, (), doc, tuple(self._constants)),)

    def _statement(self) -> None:
        cursor = self._cursor
        first = cursor.token
        if first.kind != WORD or first.text not in TOP:
            cursor.fail(
                "expected a declaration",
                "a file contains `struct`, `enum`, `typedef`, `const`, `exception` and `service`"
                " declarations, after `include` and `namespace`",
            )
        cursor.next()
        match first.text:
            case "include":
                self._include(first.span)
            case "cpp_include":
                cursor.expect_kind(TEXT, "a file in quotes")
            case "namespace":
                self._namespace()
            case "const":
                self._constant(first.span, first.doc)
            case "typedef":
                self._typedef(first.span, first.doc)
            case "enum":
                self._enum(first.span, first.doc)
            case "service":
                self._service(first.span, first.doc)
            case _:
                self._fields(first.text, first.span, first.doc)
        cursor.accept(",", ";")

    def _include(self, first: Span) -> None:
        token = self._cursor.expect_kind(TEXT, "a file in quotes")
        path = token.text[1:-1]
        if not path.lower().endswith(THRIFT_SUFFIX):
            self._cursor.report(
                codes.THRIFT_STATEMENT, token.span, f"`{path}` is not a `{THRIFT_SUFFIX}` file"
            )
            return
        self._imports.append(Import(first.cover(token.span), Text(token.span, path)))

    def _namespace(self) -> None:
        cursor = self._cursor
        if not cursor.accept("*"):
            cursor.expect_kind(WORD, "a language, such as `yarp`")
        cursor.expect_kind(WORD, "a namespace")
        read_annotations(cursor)

    def _constant(self, first: Span, doc: str) -> None:
        cursor = self._cursor
        type_ = self._types.read()
        name = cursor.name("the name of a constant")
        cursor.expect("=")
        value = read_value(cursor, self._values)
        span = first.cover(value.span)
        if value.literal is None or type_.module or type_.text not in BUILT_IN.values():
            cursor.report(
                codes.THRIFT_LEFT_OUT,
                span,
                f"the constant `{name.text}` is not imported: its type is not built in",
                "write the value in the program that needs it",
            )
        else:
            self._constants.append(ast.Constant(span, type_, name, value.literal, doc))
        if value.literal is not None:
            self._values[name.text] = value.literal

    def _typedef(self, first: Span, doc: str) -> None:
        type_ = self._types.read()
        name = self._cursor.name("the new name of the type")
        annotations = read_annotations(self._cursor)
        span = first.cover(self._cursor.last.span)
        if "yarp.name" in annotations and self._class(name, span, doc, annotations["yarp.name"]):
            return
        self._declarations.append(ast.Alias(span, name, type_, doc))

    def _enum(self, first: Span, doc: str) -> None:
        name = self._cursor.name("the name of an enumeration")
        self._cursor.expect("{")
        enumerators = self._members.enumerators()
        annotations = read_annotations(self._cursor)
        span = first.cover(self._cursor.last.span)
        if not enumerators and "yarp.name" in annotations:
            number = QualifiedName(name.span, Name(name.span, "int32"))
            self._declarations.append(ast.Alias(span, name, number, doc))
            self._report_class(name, annotations["yarp.name"], "values", "any number is accepted")
            return
        self._declarations.append(ast.Enum(span, name, enumerators, doc))

    def _service(self, first: Span, doc: str) -> None:
        cursor = self._cursor
        name = cursor.name("the name of a service")
        base = self._types.read() if cursor.accept("extends") else None
        cursor.expect("{")
        operations = self._members.operations()
        read_annotations(cursor)
        span = first.cover(cursor.last.span)
        self._declarations.append(ast.Interface(span, name, operations, doc, base))

    def _fields(self, kind: str, first: Span, doc: str) -> None:
        """A struct or exception; a union or senum is reported."""
        cursor = self._cursor
        name = cursor.name(f"the name of this {kind}")
        cursor.accept("xsd_all")
        cursor.expect("{")
        if kind == "senum":
            cursor.report(
                codes.THRIFT_UNSUPPORTED, first, "`senum` is not supported", "use an `enum`"
            )
            raise SyntaxMistake
        fields = self._members.fields()
        annotations = read_annotations(cursor)
        span = first.cover(cursor.last.span)
        if kind == "union":
            cursor.report(
                codes.THRIFT_UNSUPPORTED,
                first.cover(name.span),
                f"`{name.text}` is a union, which IDSL does not have",
                "use a struct with all fields, and an enumeration that tells which one is valid",
            )
        if kind == "exception":
            self._declarations.append(ast.ExceptionDecl(span, name, fields, doc))
            return
        original = annotations.get("yarp.name", "")
        if original and not fields and self._class(name, span, doc, original):
            return
        if original and not fields:
            self._report_class(name, original, "fields", "a peer that sends some is rejected")
        self._declarations.append(ast.Struct(span, name, fields, doc))

    def _class(self, name: Name, span: Span, doc: str, original: str) -> bool:
        """Declare a type with the layout of a class of YARP; False if it is unknown."""
        layout = _CLASSES.get(original.removeprefix("::").replace(" ", ""))
        if layout is None:
            return False
        element = QualifiedName(name.span, Name(name.span, layout.removesuffix("[]")))
        is_array = layout.endswith("[]")
        kind = ast.Sequence if is_array else ast.Alias
        self._declarations.append(kind(span, name, element, doc))
        return True

    def _report_class(self, name: Name, original: str, what: str, effect: str) -> None:
        self._cursor.report(
            codes.THRIFT_LEFT_OUT,
            name.span,
            f"`{name.text}` has no {what} here: its layout is in the C++ class `{original}`;"
            f" {effect}",
            f"write the {what} that the class has on the wire in the braces",
        )
