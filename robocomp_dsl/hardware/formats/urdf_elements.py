"""XML elements with line numbers, and numeric attributes.

In: bytes, or an element. Out: elements with their lines; faults and findings for invalid numbers.
The standard expat reads no other files and rejects entity expansion attacks.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import Kind, ModelFileError, model_finding

_DEEPEST = 100


@dataclass(slots=True)
class Element:
    """A tag without its namespace, its attributes, its first line, and its children."""

    tag: str
    attributes: dict[str, str]
    line: int
    content: list[Element] = field(default_factory=list)

    def get(self, name: str) -> str:
        """An attribute, or None."""
        return self.attributes.get(name, "").strip()

    def children(self, tag: str) -> list[Element]:
        """The children with this tag."""
        return [element for element in self.content if element.tag == tag]

    def child(self, tag: str) -> Element | None:
        """The first child with this tag."""
        return next((element for element in self.content if element.tag == tag), None)

    def all(self) -> Iterator[Element]:
        """The element itself and all its descendants."""
        todo = [self]
        while todo:
            element = todo.pop()
            yield element
            todo.extend(element.content)


def elements(data: bytes) -> Element:
    """The root element. Raises `ModelFileError` with the line."""
    parser = expat.ParserCreate()
    path = [Element("", {}, 0)]

    def begin(tag: str, attributes: dict[str, str]) -> None:
        if len(path) > _DEEPEST:
            raise ModelFileError(f"more than {_DEEPEST} elements in each other", line())
        element = Element(tag, attributes, line())
        path[-1].content.append(element)
        path.append(element)

    def line() -> int:
        return int(parser.CurrentLineNumber)

    parser.StartElementHandler = begin
    parser.EndElementHandler = lambda _: path.pop()
    try:
        parser.Parse(data, True)
    except (expat.ExpatError, UnicodeError, LookupError) as error:
        number = getattr(error, "lineno", 0)
        raise ModelFileError(f"this is no XML: {str(error).split(':')[0]}", number) from None
    return path[0].content[0]


@dataclass(slots=True)
class ElementReader:
    """`faults` make the file unusable, `findings` do not. `{}` in a message is the subject."""

    faults: list[Finding] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)

    def error(self, kind: Kind, subject: str, message: str, line: int) -> None:
        """Report a fatal problem."""
        self.faults.append(model_finding(kind, subject, message.replace("{}", subject), line))

    def warn(self, kind: Kind, subject: str, message: str, line: int) -> None:
        """Report something that was assumed or ignored."""
        self.findings.append(model_finding(kind, subject, message.replace("{}", subject), line))

    def number(self, element: Element, name: str, default: float) -> float:
        """A finite attribute; otherwise reported, and `default`."""
        return self.numbers(element, name, (default,))[0]

    def numbers(self, element: Element, name: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """As many numbers as `default` has."""
        text = element.get(name)
        if not text:
            return default
        try:
            numbers = tuple(float(word) for word in text.split())
        except ValueError:
            numbers = ()
        if len(numbers) == len(default) and all(map(math.isfinite, numbers)):
            return numbers
        many = "a finite number" if len(default) == 1 else f"{len(default)} finite numbers"
        self.error(
            "file",
            element.tag,
            f'`{name}` of `<{{}}>` must be {many}, not "{text:.40}"',
            element.line,
        )
        return default
