"""The text of an InnerModel: the text that was read, with what has changed since.

In: the nodes, and the source that they were read from. Out: its text; comments, layout, order and
units of unchanged parts are the same characters. Elements of removed nodes are left out, new and
moved ones follow the last element of their parent. An `<include>` is replaced by the elements of
its file if one of them has changed.
"""

from __future__ import annotations

import os
import threading
from collections import defaultdict
from contextlib import suppress
from pathlib import Path

from robocomp_dsl.check.innermodel.tags import INCLUDE
from robocomp_dsl.check.workspace.import_resolver import base_name
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.innermodel.element_text import ElementText, new_element, shift
from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.innermodel.node_tree import NodeTree
from robocomp_dsl.model import innermodel
from robocomp_dsl.source import Source, declare_utf8
from robocomp_dsl.syntax.ast.innermodel import Element
from robocomp_dsl.syntax.parse import parse_innermodel

_INDENT = "    "


def render(tree: NodeTree, model: innermodel.InnerModel, source: Source) -> str:
    """The text of the file `source`, from which `model` was read, with the nodes of `tree`."""
    root = _root_of(source)
    body = _Writer(tree, model, source).element(root, tree.root, source)
    return source.text[: root.span.start] + body + source.text[root.span.end :]


def write_file(path: Path, text: str, encoding: str) -> None:
    """Write a file completely or not at all. Raises `InnerModelError`."""
    try:
        data = text.encode(encoding)
    except UnicodeEncodeError:  # a new text has characters that the declared encoding lacks
        data = declare_utf8(text).encode()
    try:
        real = path.resolve()  # the target of a symbolic link, so that the link stays
        new = real.with_name(f".{real.name}.{os.getpid()}.{threading.get_ident()}.new")
        try:
            new.write_bytes(data)
            with suppress(FileNotFoundError):
                new.chmod(real.stat().st_mode & 0o777)
            new.replace(real)
        except OSError:
            with suppress(OSError):
                new.unlink()
            raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InnerModelError(f"cannot write `{path}`: {reason}") from None


def _root_of(source: Source) -> Element:
    root = parse_innermodel(source, Report()).root
    assert root is not None  # noqa: S101  a file without a root element is not loaded
    return root


class _Writer:
    """Writes elements; `folder` is that of the written file, if paths must be adapted to it."""

    def __init__(self, tree: NodeTree, model: innermodel.InnerModel, main: Source) -> None:
        self.tree = tree
        self.main = main
        self.line_end = "\r\n" if "\r\n" in main.text else "\n"
        self.nodes: dict[tuple[int, int], list[str]] = defaultdict(list)
        self.parents: dict[str, str] = {}
        self.roots = {_key(main): _root_of(main)}
        self.sources = {main.path: main}
        for node, parent in model.nodes():
            if parent is not None:
                source = node.span.source
                self.nodes[_key(source), node.span.start].append(node.id)
                self.parents[node.id] = parent.id
                self.sources.setdefault(source.path, source)
        self.elements: dict[tuple[int, int], Element] = {}

    # -- elements -----------------------------------------------------------------------------

    def element(self, element: Element, id: str, source: Source, folder: Path | None = None) -> str:
        """The text of the element of node `id`, with all below it."""
        part = ElementText(element, source)
        placed: set[str] = set()
        inside = self._inside(part, id, placed, folder)
        head = part.open_tag(self.tree, id, folder)
        added = [child for child in self.tree.entries[id].children if child not in placed]
        if not added:
            return head + inside + part.close_tag(self.tree, id)
        indent = part.child_indent() or part.indent() + self._indent_unit()
        gap = self.line_end + indent
        written = "".join(gap + self._new(child, indent) for child in added)
        content = inside.rstrip()
        end = inside[len(content) :]
        closing = end if "\n" in end else self.line_end + part.indent()
        return part.opened(head) + content + written + closing + part.close_tag(self.tree, id)

    def _inside(self, part: ElementText, parent: str, placed: set[str], folder: Path | None) -> str:
        """What is between the tags: the elements that are still here; adds these to `placed`."""
        pieces = []
        text, at = part.source.text, part.content_start
        for child in part.element.children:
            gap, at = text[at : child.span.start], child.span.end
            if child.tag.text.lower() == INCLUDE:
                written = self._include(child, part.source, parent, placed, folder)
            else:
                written = self._child(child, part.source, parent, placed, folder)
            pieces += [gap, written] if written is not None else [_without_line(gap)]
        return "".join(pieces) + text[at : part.content_end]

    def _child(
        self, element: Element, source: Source, parent: str, placed: set[str], folder: Path | None
    ) -> str | None:
        """The element of a node; None if the node was removed, or moved to another parent."""
        for name in self.nodes.get((_key(source), element.span.start), ()):
            entry = self.tree.entries.get(name)
            here = entry is not None and entry.original is not None and entry.parent == parent
            if here and self.parents[name] == parent and name not in placed:
                placed.add(name)
                return self.element(element, name, source, folder)
        return None

    def _include(
        self, element: Element, source: Source, parent: str, placed: set[str], folder: Path | None
    ) -> str | None:
        """The element as it is, or the elements of its file if one has changed."""
        unchanged = ElementText(element, source).relocated(folder)
        included = self._included(element, source)
        if included is None:
            return unchanged
        part = ElementText(self._root(included), included)
        before = set(placed)
        text = self._inside(part, parent, placed, None)
        if text == included.text[part.content_start : part.content_end]:
            return unchanged
        if included.path.parent != self.main.path.parent or folder:
            folder = self.main.path.parent
            text = self._inside(part, parent, before, folder)
        indent = ElementText(element, source).indent()
        return shift(text.strip(), part.child_indent(), indent) or None

    def _included(self, element: Element, source: Source) -> Source | None:
        """The source that an `<include>` was replaced by; None if it has no nodes."""
        written = element.get("path")
        if written is None:
            return None
        name = written.value.value.strip()
        paths = (source.path.parent / name, source.path.parent / base_name(name))
        return next((self.sources[path] for path in paths if path in self.sources), None)

    # -- new and moved nodes ------------------------------------------------------------------

    def _new(self, id: str, indent: str) -> str:
        """The text of a node that was added or moved here."""
        original = self.tree.entries[id].original
        if original is None:
            entry = self.tree.entries[id]
            inner = indent + self._indent_unit()
            children = [inner + self._new(child, inner) for child in entry.children]
            return new_element(self.tree.node(id), children, indent, self.line_end)
        source = original.span.source
        element = self._element_at(source, original.span.start)
        moved = source.path.parent != self.main.path.parent
        text = self.element(element, id, source, self.main.path.parent if moved else None)
        return shift(text, ElementText(element, source).indent(), indent)

    def _element_at(self, source: Source, start: int) -> Element:
        if (_key(source), start) not in self.elements:
            todo = [self._root(source)]
            while todo:
                element = todo.pop()
                self.elements[_key(source), element.span.start] = element
                todo.extend(element.children)
        return self.elements[_key(source), start]

    def _root(self, source: Source) -> Element:
        if _key(source) not in self.roots:
            self.roots[_key(source)] = _root_of(source)
        return self.roots[_key(source)]

    def _indent_unit(self) -> str:
        """The indentation of one level in the main file."""
        return ElementText(self.roots[_key(self.main)], self.main).child_indent() or _INDENT


def _key(source: Source) -> int:
    """A key for a source; hashing its text takes long."""
    return id(source)


def _without_line(gap: str) -> str:
    """The text before an element that is left out: without the beginning of its line."""
    end = len(gap.rstrip(" \t"))
    if gap[:end].endswith("\n"):
        end -= 2 if gap[:end].endswith("\r\n") else 1
    return gap[:end]
