"""The tree of an InnerModel or SCXML file: XML elements as written, not judged."""

from __future__ import annotations

from robocomp_dsl.syntax.ast_base import Name, Node, Text


class Attribute(Node):
    """`tx="100"`; in `value.value` the entities are replaced."""

    name: Name
    value: Text


class Element(Node):
    """`<tag …>…</tag>`; `span` covers all of it. No two attributes have the same name.

    `texts` is what stands between the tags, where the language has such texts (SCXML).
    """

    tag: Name
    attributes: tuple[Attribute, ...] = ()
    children: tuple[Element, ...] = ()
    texts: tuple[Text, ...] = ()

    def get(self, name: str) -> Attribute | None:
        """The attribute called `name`."""
        return next((one for one in self.attributes if one.name.text == name), None)


class File(Node):
    """One file; `root` is None when there is no element to be seen.

    `complete` is False when form errors were reported, so that something may be missing here.
    """

    root: Element | None
    complete: bool = True
