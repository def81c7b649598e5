"""Bottle definitions: builds the tree of `ast.idsl`, a module with a struct named after the file.

In: the text of `gaze.bottle`. Out: the tree, and syntax diagnostics. YARP has no language for the
layout of a Bottle: its programs agree on one in their documentation. This one is the text form of a
Bottle with the type and the name of each item in place of its value:

    (float64 angle [deg])
    (target (float64 x [m]) (float64 y [m]))
    (string names *)

A file whose only field is repeated, `(float64 *)`, is a sequence: the message is the list itself.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Name, QualifiedName, Unit
from robocomp_dsl.syntax.bottle.items import BottleItem, read_items
from robocomp_dsl.syntax.codes import yarp as codes
from robocomp_dsl.syntax.definitions import module_name
from robocomp_dsl.syntax.file_diagnostics import LIMIT

BUILT_IN = {
    "bool": "bool",
    "int8": "int8",
    "int16": "int16",
    "int": "int32",
    "int32": "int32",
    "int64": "int64",
    "float": "float32",
    "float32": "float32",
    "double": "float64",
    "float64": "float64",
    "string": "string",
    "blob": "blob",
}
"""The types of items, and what they are called in the tree."""


class _Mistake(Exception):
    """A list that cannot be read; it is reported."""


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a Bottle definition."""
    return _Builder(source, report).file()


class _Builder:
    """Builds the nodes of one definition."""

    def __init__(self, source: Source, report: Report) -> None:
        self._source = source
        self._report = report
        self._count = 0
        self._declarations: dict[str, ast.Declaration] = {}
        self._name = module_name(source.path)

    def file(self) -> ast.File:
        """The whole tree."""
        size = len(self._source.text)
        span = self._source.span(0, size)
        items, doc = read_items(self._source, self._add)
        if not items and not self._count:
            self._add(self._source.file_span, "the file describes no item", "write `(type name)`")
        own = Name(self._source.span(0, 0), self._name)
        if len(items) == 1 and items[0].repeat and len(items[0].words) == 1:
            self._sequence(items[0], own, span, doc)
        else:
            fields = self._fields(items, self._name)
            self._declarations[self._name] = ast.Struct(span, own, fields, doc)
        # Not where the struct is: positions identify declarations.
        name = Name(self._source.span(size, size), self._name)
        module = ast.Module(span, name, tuple(self._declarations.values()), origin="bottle")
        return ast.File(span, (), (module,), not self._count)

    def _fields(self, items: list[BottleItem], inside: str) -> tuple[ast.Field, ...]:
        fields = []
        for item in items:
            try:
                fields.append(self._field(item, inside))
            except _Mistake:
                continue
        return tuple(fields)

    def _field(self, item: BottleItem, inside: str) -> ast.Field:
        if item.items:
            return self._nested(item, inside)
        if len(item.words) != 2:
            raise self._add(item.span, "an item has a type and a name", "write `(float64 angle)`")
        type_ = self._type(item.words[0], item)
        name = Name(item.words[1], item.words[1].text)
        if item.unit and type_.text in ("bool", "string", "blob"):
            raise self._add(item.unit, f"`{name.text}` is not a number and has no unit")
        array = ast.Array(item.repeat) if item.repeat else None
        return ast.Field(item.span, type_, name, None, _unit(item), item.doc, array)

    def _nested(self, item: BottleItem, inside: str) -> ast.Field:
        """A nested list: a field with a struct of its own."""
        if len(item.words) != 1 or item.unit:
            raise self._add(item.span, "a nested list has a name and items, and no unit or type")
        word = item.words[0]
        name = f"{inside}_{word.text}"
        while name in self._declarations:
            name += "_"
        self._declarations[name] = ast.Struct(item.span, Name(word, name), ())  # claim the name
        fields = self._fields(item.items, name)
        # The struct is where the list begins: the name is that of the field.
        start = item.span.subspan(item.span.start, item.span.start)
        self._declarations[name] = ast.Struct(item.span, Name(start, name), fields, item.doc)
        type_ = QualifiedName(start.cover(word), Name(start, name))
        array = ast.Array(item.repeat) if item.repeat else None
        return ast.Field(item.span, type_, Name(word, word.text), None, None, item.doc, array)

    def _sequence(self, item: BottleItem, name: Name, span: Span, doc: str) -> None:
        """A file that is one repeated item without a name."""
        try:
            type_ = self._type(item.words[0], item)
        except _Mistake:
            return
        doc = "\n".join(text for text in (doc, item.doc, _in_brackets(item)) if text)
        self._declarations[self._name] = ast.Sequence(span, name, type_, doc)

    def _type(self, span: Span, item: BottleItem) -> QualifiedName:
        word = BUILT_IN.get(span.text.lower())
        if word is None:
            help_ = f"the types are {', '.join(f'`{known}`' for known in BUILT_IN)}"
            raise self._add(span, f"`{span.text}` is not a type of an item", help_)
        if word != "blob":
            return QualifiedName(span, Name(span, word))
        if item.repeat:
            raise self._add(item.repeat, "a `blob` cannot be repeated")
        element = QualifiedName(span, Name(span, "uint8"))
        blob = ast.Sequence(span, Name(span, "Blob"), element, is_implicit=True)
        written = self._declarations.setdefault("Blob", blob)
        return QualifiedName(span, Name(span, written.name.text))

    def _add(self, span: Span, message: str, help_: str = "") -> _Mistake:
        """Report a mistake; of very many the first ones."""
        self._count += 1
        if self._count <= LIMIT:
            self._report.add(codes.BOTTLE_STATEMENT, span, message, help=help_)
        return _Mistake()


def _unit(item: BottleItem) -> Unit | None:
    return Unit(item.unit, item.unit.text[1:-1].strip()) if item.unit else None


def _in_brackets(item: BottleItem) -> str:
    return item.unit.text if item.unit else ""
