"""Types of Thrift: built-in ones, names, and `list`, `set`, `map` and `binary`.

In: tokens. Out: names of types in the tree. Thrift's containers have no names, those of IDSL have:
each container that a file uses becomes one implicit declaration, such as `ListOfDouble`.
"""

from __future__ import annotations

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Name, QualifiedName
from robocomp_dsl.syntax.codes import yarp as codes
from robocomp_dsl.syntax.thrift.cursor import Cursor, SyntaxMistake
from robocomp_dsl.syntax.thrift.tokens import SIGN, TEXT, WORD

BUILT_IN = {
    "bool": "bool",
    "byte": "int8",
    "i8": "int8",
    "i16": "int16",
    "i32": "int32",
    "i64": "int64",
    "float": "float32",
    "double": "float64",
    "string": "string",
}
"""The built-in types of Thrift, and what they are called in the tree."""
BINARY = "binary"
CONTAINERS = ("list", "set", "map")
MAX_DEPTH = 20
"""Maximum depth of containers in containers."""


class TypeReader:
    """The types of one file; `implicit` are the containers that it uses, in order."""

    def __init__(self, cursor: Cursor, names: set[str]) -> None:
        """`names` are those that the file declares."""
        self.implicit: dict[str, ast.Sequence | ast.Dictionary] = {}
        self._cursor = cursor
        self._names = set(names)

    def read(self, depth: int = 0) -> QualifiedName:
        """Read a type with the annotations behind it. Raises `SyntaxMistake`."""
        cursor = self._cursor
        token = cursor.token
        if depth > MAX_DEPTH:
            cursor.fail(f"expected at most {MAX_DEPTH} containers in each other")
        if token.text in CONTAINERS and cursor.following.text in ("<", "cpp_type"):
            name = self._container(depth)
        else:
            cursor.expect_kind(WORD, "a type")
            name = self._named(token.span, token.text)
            if cursor.token.text == "<":
                message = f"`{token.text}` is not `list`, `set` or `map`"
                cursor.report(codes.THRIFT_STATEMENT, token.span, message)
                raise SyntaxMistake
        read_annotations(cursor)
        return name

    def _named(self, span: Span, word: str) -> QualifiedName:
        if word in BUILT_IN:
            return QualifiedName(span, Name(span, BUILT_IN[word]))
        if word == BINARY:
            element = QualifiedName(span, Name(span, "uint8"))
            return self._declare(BINARY, "Binary", span, span, (element,))
        file, _, name = word.rpartition(".")
        if not name or not all(part.isidentifier() for part in word.split(".")):
            self._cursor.report(codes.THRIFT_STATEMENT, span, f"`{word}` is not a type")
            raise SyntaxMistake
        dot = span.start + len(file)
        if not file:
            return QualifiedName(span, Name(span, word))
        return QualifiedName(
            span,
            Name(span.subspan(dot + 1, span.end), name),
            Name(span.subspan(span.start, dot), file.rpartition(".")[2]),
        )

    def _container(self, depth: int) -> QualifiedName:
        cursor = self._cursor
        word = cursor.next()
        if cursor.accept("cpp_type"):
            cursor.expect_kind(TEXT, "a type of C++ in quotes")
        cursor.expect("<")
        types = [self.read(depth + 1)]
        if word.text == "map":
            cursor.expect(",")
            types.append(self.read(depth + 1))
        whole = word.span.cover(cursor.expect(">").span)
        described = ", ".join(type_.text for type_ in types)
        parts = "To".join(self._part(type_) for type_ in types)
        key = f"{word.text}<{described}>"
        return self._declare(key, f"{word.text.capitalize()}Of{parts}", word.span, whole, types)

    @staticmethod
    def _part(type_: QualifiedName) -> str:
        short = {"float64": "double", "float32": "float"}.get(type_.name.text, type_.name.text)
        return short[:1].upper() + short[1:]

    def _declare(
        self,
        key: str,
        name: str,
        word: Span,
        whole: Span,
        types: tuple[QualifiedName, ...] | list[QualifiedName],
    ) -> QualifiedName:
        """The implicit declaration of a container, which is where it is first used."""
        known = self.implicit.get(key)
        if known is None:
            while name in self._names:
                name += "_"
            self._names.add(name)
            written = Name(word, name)
            if len(types) == 1:
                known = ast.Sequence(whole, written, types[0], is_implicit=True)
            else:
                known = ast.Dictionary(whole, written, types[0], types[1], is_implicit=True)
            self.implicit[key] = known
        return QualifiedName(whole, Name(word, known.name.text))


def read_annotations(cursor: Cursor) -> dict[str, str]:
    """Read `(yarp.name = "…", final)`, if it follows: names and their texts."""
    found: dict[str, str] = {}
    if not cursor.accept("("):
        return found
    while not cursor.accept(")"):
        key = cursor.expect_kind(WORD, "the name of an annotation or `)`")
        found[key.text] = ""
        if cursor.accept("="):
            value = cursor.next()
            if value.kind == SIGN or cursor.is_at_end:
                cursor.fail("expected the value of an annotation")
            found[key.text] = value.text[1:-1] if value.kind == TEXT else value.text
        cursor.accept(",", ";")
    return found
