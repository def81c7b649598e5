"""The text of one element: its tags as they were written, with changed attributes.

In: an element and its source, or a new node. Out: pieces of text. The characters of an attribute
that has not changed stay as they are.
"""

from __future__ import annotations

import os
from dataclasses import MISSING, fields
from pathlib import Path

from robocomp_dsl.check.innermodel.tags import TAGS
from robocomp_dsl.innermodel.attribute_values import escaped, text_of
from robocomp_dsl.innermodel.node_tree import POSE, NodeTree
from robocomp_dsl.model.innermodel import Node
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast.innermodel import Element
from robocomp_dsl.syntax.xml.xml_tokens import group_tags

_FILES = ("file", "texture", "path")
"""Attributes with the name of a file."""

Edit = tuple[int, int, str]

_ORDER = list(dict.fromkeys(name for tag in TAGS.values() for name in tag.attributes))
"""The order of attributes that are added to an element."""


class ElementText:
    """An element in its source. Content is what is between its tags, offsets are of the source."""

    def __init__(self, element: Element, source: Source) -> None:
        self.element = element
        self.source = source
        text = source.text
        last = element.attributes[-1].span.end if element.attributes else element.tag.span.end
        self.content_start = text.index(">", last) + 1
        self.empty = text[self.content_start - 2] == "/"
        """Whether the element is one tag, `<… />`."""
        end = self.content_start if self.empty else text.rindex("</", last, element.span.end)
        self.content_end = end

    def indent(self) -> str:
        """The white space before the element in its line; empty if other text is there."""
        return _indent_at(self.source.text, self.element.span.start)

    def child_indent(self) -> str:
        """The white space before the first child in its line; empty if other text is there."""
        children = self.element.children
        return _indent_at(self.source.text, children[0].span.start) if children else ""

    # -- tags ---------------------------------------------------------------------------------

    def open_tag(self, tree: NodeTree, id: str, folder: Path | None) -> str:
        """The first tag of the element, with the current values of node `id`."""
        values = _changed_values(tree, id)
        kinds = TAGS[_tag(tree, id)].attributes if values else {}
        texts: dict[str, str] = {}
        for name, value in values.items():
            written = self.element.get(name)
            texts[name] = text_of(value, kinds[name], written.value.value if written else "")
        edits = self._attribute_edits(self._paths(folder) | texts)
        if values and not _same_tag(tree, id):
            edits.append((self.element.tag.span.start, self.element.tag.span.end, _tag(tree, id)))
        return self._edited(edits, self.content_start)

    def opened(self, head: str) -> str:
        """The first tag for an element with content."""
        return head[:-2].rstrip() + ">" if self.empty else head

    def close_tag(self, tree: NodeTree, id: str) -> str:
        """The closing tag; nothing if the element was one tag and has got no content."""
        renamed = bool(_changed_values(tree, id)) and not _same_tag(tree, id)
        name = _tag(tree, id) if renamed else self.element.tag.text
        if self.empty:
            return f"</{name}>" if _has_new_content(self.element, tree, id) else ""
        written = self.source.text[self.content_end : self.element.span.end]
        return f"</{name}>" if renamed else written

    def relocated(self, folder: Path | None) -> str:
        """All of the element; names of files are relative to `folder`."""
        return self._edited(self._attribute_edits(self._paths(folder)), self.element.span.end)

    # -- attributes ---------------------------------------------------------------------------

    def _paths(self, folder: Path | None) -> dict[str, str]:
        """The attributes with relative names of files, made relative to `folder`."""
        found: dict[str, str] = {}
        for name in _FILES if folder else ():
            written = self.element.get(name)
            value = written.value.value.strip() if written else ""
            if value and folder and not value.startswith("#") and not Path(value).is_absolute():
                file = os.path.relpath(self.source.path.parent / value, folder)
                found[name] = Path(file).as_posix()
        return found

    def _attribute_edits(self, texts: dict[str, str]) -> list[Edit]:
        """The edits that give attributes these texts; a new one follows the last attribute."""
        edits: list[Edit] = []
        attributes = self.element.attributes
        end = attributes[-1].span.end if attributes else self.element.tag.span.end
        for name, text in texts.items():
            attribute = self.element.get(name)
            if attribute is None:
                edits.append((end, end, f' {name}="{escaped(text)}"'))
                continue
            span = attribute.value.span
            quote = self.source.text[span.start]
            edits.append((span.start, span.end, f"{quote}{escaped(text, quote)}{quote}"))
            edits += self._repetitions(name, attribute.span.start)
        return edits

    def _repetitions(self, name: str, first: int) -> list[Edit]:
        """The edits that remove later attributes of this name, which had the same value."""
        start, text = self.element.span.start, self.source.text
        edits: list[Edit] = []
        for token in next(group_tags(text[start : self.content_start])):
            at = start + token.start
            same = token.kind == "ATTRIBUTE" and token.text.partition("=")[0].strip() == name
            if same and at != first:
                edits.append((len(text[:at].rstrip()), start + token.end, ""))
        return edits

    def _edited(self, edits: list[Edit], end: int) -> str:
        """The text from the start of the element to `end`, with the edits."""
        pieces, at = [], self.element.span.start
        for first, last, text in sorted(edits, key=lambda edit: edit[:2]):
            pieces += [self.source.text[at:first], text]
            at = last
        return "".join(pieces) + self.source.text[at:end]


def new_element(node: Node, children: list[str], indent: str, line_end: str) -> str:
    """The text of a node without one: its attributes that have not the default."""
    known = TAGS[node.tag].attributes
    defaults = {field.name: field.default for field in fields(node)}
    written = [f'id="{escaped(node.id)}"']
    for name, kind in known.items():
        value = getattr(node, name)
        if name != "id" and (defaults[name] is MISSING or value != defaults[name]):
            written.append(f'{name}="{escaped(text_of(value, kind))}"')
    head = f"<{node.tag} {' '.join(written)}"
    if not children:
        return f"{head}/>"
    inside = "".join(f"{child}{line_end}" for child in children)
    return f"{head}>{line_end}{inside}{indent}</{node.tag}>"


def shift(text: str, old: str, new: str) -> str:
    """The lines after the first with the indentation `new` instead of `old`."""
    if old == new:
        return text
    first, *lines = text.split("\n")
    fits = (bool(line.strip()) and line.startswith(old) for line in lines)
    moved = (new + line[len(old) :] if fit else line for line, fit in zip(lines, fits, strict=True))
    return "\n".join([first, *moved])


def _indent_at(text: str, offset: int) -> str:
    line = text[text.rfind("\n", 0, offset) + 1 : offset]
    return line if not line.strip() else ""


def _changed_values(tree: NodeTree, id: str) -> dict[str, object]:
    """The attributes of a node whose values differ from those that were read."""
    original, node = tree.entries[id].original, tree.node(id)
    if original is None or node is original:
        return {}
    values: dict[str, object] = {}
    for name in TAGS[node.tag].attributes.keys() | (set(POSE) if hasattr(node, "tx") else set()):
        value = getattr(node, name)
        if value != getattr(original, name):
            values[name] = value
    return {name: values[name] for name in sorted(values, key=_ORDER.index)}


def _same_tag(tree: NodeTree, id: str) -> bool:
    return _tag(tree, id) == tree.entries[id].node.tag


def _tag(tree: NodeTree, id: str) -> str:
    """The tag of a node: a `translation` that was turned needs another one."""
    tag = tree.entries[id].node.tag
    if tag not in {"translation", "rotation"}:
        return tag
    known = TAGS[tag].attributes
    changed = _changed_values(tree, id)
    return "transform" if any(name in changed and name not in known for name in POSE) else tag


def _has_new_content(element: Element, tree: NodeTree, id: str) -> bool:
    return bool(tree.entries[id].children) and not element.children
