"""Reads XML files of YARP as elements with positions.

In: a source. Out: the root element, and findings. The parser accepts what YARP's own parser does:
undeclared prefixes of namespaces, document types, comments with dashes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast.innermodel import Element
from robocomp_dsl.syntax.parse import parse_xml

_HARMLESS = ("RC184", "RC185", "RC187")
"""Text between tags, document types, dashes in comments. A lone `&` stands for itself, too."""
_PROLOGUE = re.compile(r"<\?.*?\?>|<!--.*?-->", re.DOTALL)
_ROOT = re.compile(r"<\s*([\w.:-]+)")

APPLICATION = "application"
ROBOT_ROOTS = ("robot", "devices", "device")
PARTIAL_ROOTS = ("params", "param", "actions", "action", "group")
"""Roots of files that a description of yarprobotinterface includes."""
OTHER_ROOTS = ("module", "resources", "cluster", "templates", *PARTIAL_ROOTS)
"""Roots of files of YARP that are not migrated by themselves."""


def root_name(source: Source) -> str:
    """The name of the root element in lower case; empty if there is none."""
    match = _ROOT.search(_PROLOGUE.sub("", source.text))
    return match[1].rpartition(":")[2].lower() if match else ""


def read_document(source: Source, report: Report) -> Element | None:
    """The root element; syntax errors are added to `report`."""
    own = Report()
    tree = parse_xml(source, own)
    report.extend(
        finding
        for finding in own
        if finding.code.id not in _HARMLESS and not finding.span.text.startswith("&")
    )
    return tree.root


def name_of(element: Element) -> str:
    """The name of an element in lower case, without its namespace."""
    return element.tag.text.rpartition(":")[2].lower()


def text_of(element: Element | None) -> str:
    """The text of an element, with single spaces; empty without an element."""
    parts = (text.value for text in element.texts) if element else ()
    return " ".join(" ".join(parts).split())


def attribute(element: Element, name: str) -> str:
    """The value of an attribute; empty if there is none."""
    found = element.get(name)
    return found.value.value.strip() if found else ""


def children(element: Element, *names: str) -> Iterator[Element]:
    """The children with one of `names`."""
    return (child for child in element.children if name_of(child) in names)


def child(element: Element, *names: str) -> Element | None:
    """The first child with one of `names`."""
    return next(children(element, *names), None)
