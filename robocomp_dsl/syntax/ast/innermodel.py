"""The tree of an InnerModel or SCXML file: XML elements as written, not checked."""

from __future__ import annotations

from robocomp_dsl.syntax.ast.base import Name, Node, Text


class Attribute(Node):
    """`tx="100"`; in `value.value` the entities are replaced."""

    name: Name
    value: Text


class Element(Node):
    """`<tag …>…</tag>`; `span` covers all of it. No two attributes have the same name.

    `texts` is the text between the tags if the language uses it (SCXML).
    """

    tag: Name
    attributes: tuple[Attribute, ...] = ()
    children: tuple[Element, ...] = ()
    texts: tuple[Text, ...] = ()

    def get(self, name: str) -> Attribute | None:
        """The attribute called `name`."""
        return next(
            (attribute for attribute in self.attributes if attribute.name.text == name), None
        )


class File(Node):
    """One file; `root` is None if the file has no element.

    `complete` is False if syntax errors were reported, so parts may be missing.
    """

    root: Element | None
    complete: bool = True
