"""ROS definitions: builds the tree of `ast.idsl`, a module of structs named after the package.

In: the text of `package/msg/Name.msg`, `package/srv/Name.srv` or `package/action/Name.action`. Out:
the tree, with one import for each other definition that it uses, and syntax diagnostics. The
language: https://docs.ros.org/en/kilted/Concepts/Basic/About-Interfaces.html; names without a
package and the types `time` and `duration` as in ROS 1.
"""

from __future__ import annotations

import re
from pathlib import Path

from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Import, Name, QualifiedName, Text, Unit
from robocomp_dsl.syntax.codes import ros as codes
from robocomp_dsl.syntax.comment_units import unit_in
from robocomp_dsl.syntax.ros.kinds import ROS_PARTS
from robocomp_dsl.syntax.ros.lines import DefinitionLine, Section, read_sections
from robocomp_dsl.syntax.ros.values import parse_items, parse_value

_SIZED = [f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)]
NUMBERS = frozenset(("byte", "char", "float32", "float64", *_SIZED))
BUILT_IN = NUMBERS | {"bool", "string"}
"""The built-in types of ROS definitions."""
MAX_LENGTH = 1_000_000
"""Largest length of an array."""

_STATEMENT = re.compile(
    r"(?P<type>[A-Za-z_][\w/]*)(?:<=(?P<text>\d+))?(?P<array>\[(?P<most><=)?(?P<length>\d*)\])?"
    r"\s+(?P<name>[A-Za-z]\w*)\s*(?P<rest>.*)",
    re.ASCII,
)
_REFERENCE = re.compile(r"(?:([A-Za-z]\w*)/(?:msg/)?)?([A-Za-z]\w*)")
_ROS1 = {
    "time": ("builtin_interfaces", "Time"),
    "duration": ("builtin_interfaces", "Duration"),
    "Header": ("std_msgs", "Header"),
}
"""Types that ROS 1 definitions name without a package."""
_UNSUPPORTED = ("wstring", "wchar", "float128")


def definition_name(path: Path) -> tuple[str, str, str]:
    """Package, folder and name of a definition, by its path: `sensor_msgs`, `msg`, `Image`."""
    folder = path.suffix[1:].lower()
    home = path.parent
    package = home.parent.name if home.name == folder else home.name
    return package, folder, path.stem


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a ROS definition; its kind is that of the file name."""
    own = Report()
    file = _Builder(source, own).file()
    report.extend(own)
    return file


class _Builder:
    """Builds the nodes of one definition."""

    def __init__(self, source: Source, report: Report) -> None:
        self._source = source
        self._report = report
        self._package, self._folder, self._name = definition_name(source.path)
        self._imports: dict[str, Import] = {}
        self._failed = False

    def file(self) -> ast.File:
        """The whole tree."""
        parts = ROS_PARTS[self._source.path.suffix.lower()]
        sections = read_sections(self._source)
        self._check_sections(sections, len(parts))
        size = len(self._source.text)
        ends = [*(section.span.start for section in sections[1:]), size]
        structs = [
            self._struct(f"{self._name}{part}", section, end)
            for part, section, end in zip(parts, sections, ends, strict=False)
        ]
        span = self._source.span(0, size)
        # Not where the first struct is: positions identify declarations.
        name = Name(self._source.span(size, size), self._package)
        module = ast.Module(span, name, tuple(structs), origin="ros")
        return ast.File(span, tuple(self._imports.values()), (module,), not self._failed)

    def _check_sections(self, sections: list[Section], expected: int) -> None:
        suffix = self._source.path.suffix.lower()
        number = ("no line", "one line", "two lines")[expected - 1]
        message = f"a `{suffix}` file has {number} `---` between its parts"
        if len(sections) > expected:
            self._add(sections[expected].span, message)
        elif len(sections) < expected:
            self._add(self._source.span(len(self._source.text), len(self._source.text)), message)

    def _struct(self, name: str, section: Section, end: int) -> ast.Struct:
        fields: list[ast.Field] = []
        constants: list[ast.Constant] = []
        for statement in section.statements:
            node = self._statement(statement)
            if isinstance(node, ast.Field):
                fields.append(node)
            elif node is not None:
                constants.append(node)
        return ast.Struct(
            self._source.span(section.span.start, end),
            Name(section.span, name),
            tuple(fields),
            section.doc,
            tuple(constants),
            f"{self._package}/{self._folder}/{name}",
        )

    def _statement(self, statement: DefinitionLine) -> ast.Field | ast.Constant | None:
        span = statement.span
        found = _STATEMENT.fullmatch(span.text)
        if found is None or found["rest"] == ";":
            self._report_statement(span)
            return None
        type_ = self._type(self._part(span, found, "type"))
        if type_ is None:
            return None
        name = Name(self._part(span, found, "name"), found["name"])
        rest = self._part(span, found, "rest")
        if found["rest"].startswith("="):
            if found["array"] or found["text"]:
                self._add(span, "a constant is a single number, bool or string without a bound")
                return None
            value = rest.subspan(rest.start + 1, rest.end)
            literal = parse_value(value, type_.text)
            if literal is None:
                self._add(span, f"the constant `{name.text}` has no value")
                return None
            return ast.Constant(span, type_, name, literal, statement.doc)
        array, string_bound = self._array(span, found), self._string_bound(span, found)
        items = parse_items(rest, type_.text) if array else ()
        if items is None:
            self._add(rest, "the default of an array is a list, such as `[1, 2]`")
        is_number = type_.text in NUMBERS
        unit, doc = unit_in(statement.doc) if is_number else ("", statement.doc)
        default = parse_value(rest, type_.text) if found["rest"] and not array else None
        return ast.Field(
            span,
            type_,
            name,
            default,
            Unit(name.span, unit) if unit else None,
            doc,
            array,
            string_bound,
            items or (),
        )

    def _part(self, span: Span, found: re.Match[str], group: str) -> Span:
        return span.subspan(span.start + found.start(group), span.start + found.end(group))

    def _type(self, span: Span) -> QualifiedName | None:
        """The built-in type or the imported struct that a word names."""
        word = span.text
        if word in BUILT_IN:
            return QualifiedName(span, Name(span, word))
        if word in _UNSUPPORTED:
            self._failed = True
            self._report.add(
                codes.ROS_UNSUPPORTED_TYPE,
                span,
                f"`{word}` is not supported: the middlewares of ROS 2 encode it differently",
                help="use `float64`" if word == "float128" else "use `string`, which is UTF-8",
            )
            return None
        reference = _REFERENCE.fullmatch(word)
        if reference is None:
            self._add(span, f"`{word}` is not a type", help_="write `package/Name` or `Name`")
            return None
        package, name = _ROS1.get(word, (reference[1] or self._package, reference[2]))
        path = f"{package}/msg/{name}.msg"
        if (package, "msg", name) == (self._package, self._folder, self._name):
            self._add(span, f"`{name}` contains itself", help_="ROS has no recursive messages")
            return None
        self._imports.setdefault(path, Import(span, Text(span, path)))
        return QualifiedName(span, Name(span, name), Name(span, package))

    def _string_bound(self, span: Span, found: re.Match[str]) -> int:
        if not found["text"]:
            return 0
        length = self._length(self._part(span, found, "text"), "a string")
        if found["type"] != "string":
            self._add(span, f"only a `string` can have a bound before its name, not `{found[1]}`")
            return 0
        return length

    def _length(self, span: Span, what: str) -> int:
        """A length that is written in digits; 0 if it is out of range."""
        length = int(span.text) if 0 < len(span.text) <= len(str(MAX_LENGTH)) else 0
        if not 1 <= length <= MAX_LENGTH:
            self._add(span, f"the length of {what} is 1 to {MAX_LENGTH}")
            return 0
        return length

    def _array(self, span: Span, found: re.Match[str]) -> ast.Array | None:
        if not found["array"]:
            return None
        brackets = self._part(span, found, "array")
        is_limited = found["length"] or found["most"]
        length = self._length(self._part(span, found, "length"), "an array") if is_limited else 0
        if found["most"]:
            return ast.Array(brackets, bound=length)
        return ast.Array(brackets, size=length)

    def _report_statement(self, span: Span) -> None:
        plain = span.text.rstrip("; ")
        if plain != span.text and _STATEMENT.fullmatch(plain):
            end = span.subspan(span.start + len(plain), span.end)
            fix = Fix("remove the `;`", (Edit(end, ""),))
            self._add(end, "a line of a ROS definition does not end with `;`", fix=fix)
            return
        self._add(
            span,
            f"`{span.text}` is neither a field nor a constant",
            help_="a field is `type name`, a constant is `type NAME=value`",
        )

    def _add(self, span: Span, message: str, help_: str = "", fix: Fix | None = None) -> None:
        self._failed = True
        self._report.add(codes.ROS_STATEMENT, span, message, help=help_, fix=fix)
