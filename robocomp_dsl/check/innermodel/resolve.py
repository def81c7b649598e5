"""Resolves InnerModel files with their includes.

In: the path of a file. Out: an `InnerModel`, always; faulty elements are reported and left out, and
faulty attributes have their default.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check.codes import innermodel as codes
from robocomp_dsl.check.innermodel.tags import INCLUDE, ROOT, TAGS, TEXT, InnerModelTag
from robocomp_dsl.check.innermodel.values import read_values
from robocomp_dsl.check.workspace.import_resolver import base_name
from robocomp_dsl.check.workspace.source_cache import SourceCache, canonical_path
from robocomp_dsl.diagnostics import Note, Report, did_you_mean, nearest
from robocomp_dsl.model.innermodel import InnerModel, Node, Transform
from robocomp_dsl.source import Source, Span, UnreadableSource
from robocomp_dsl.syntax.ast.innermodel import Element, File
from robocomp_dsl.syntax.parse import parse_innermodel

MAX_DEPTH = 200
"""Maximum depth of nested elements; the deepest known robot has about 60."""

MAX_NODES = 100_000
"""Maximum number of nodes including those of included files."""

ROOT_ID = "root"
_NAMELESS = ("axes", "taxel")
"""Tags of nodes that need no id."""
_OTHERS = {
    "rcmanager": "a deployment for rcmanager, not an InnerModel",
    "agmmodel": "a world model for AGM, not an InnerModel",
    "scxml": "a state machine; rename the file to `.scxml`",
    "robot": "a robot in URDF, not in InnerModel",
    "mujoco": "a model for MuJoCo, not in InnerModel",
}
"""Root elements, in lower case, of other common XML files."""
_INCLUDE = InnerModelTag(Node, {"path": TEXT})


def resolve_innermodel(path: Path, files: SourceCache, report: Report) -> InnerModel:
    """The InnerModel at `path`. Raises `UnreadableSource` for that file only."""
    return _Resolver(files, report).body(path)


def _is_body(root: Element | None) -> bool:
    """Whether the root element is that of InnerModel."""
    return root is not None and root.tag.text.lower() == ROOT


@dataclass(slots=True)
class _Resolver:
    files: SourceCache
    report: Report
    ids: dict[str, Span] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    including: list[str] = field(default_factory=list)
    file_span: Span = field(init=False)

    def body(self, path: Path) -> InnerModel:
        tree = self._tree(path)
        self.file_span = tree.span.source.file_span
        self.ids[ROOT_ID] = self.file_span
        self.including.append(canonical_path(path))
        nodes = self._document(tree, 0)
        root = Transform(id=ROOT_ID, tag=ROOT, span=tree.span, children=nodes)
        return InnerModel(path, root, has_root=_is_body(tree.root))

    def _tree(self, path: Path) -> File:
        parsed = self.files.parse(path, parse_innermodel)
        self.report.extend(parsed.diagnostics)
        return parsed.tree

    def _document(self, tree: File, depth: int) -> tuple[Node, ...]:
        """The nodes in the root element of a file."""
        root = tree.root
        if root is None:
            return ()
        if not _is_body(root):
            other = _OTHERS.get(root.tag.text.lower(), "")
            self.report.add(
                codes.INNERMODEL_TAG,
                root.tag.span,
                f"the root element is `<{root.tag.text}>`; it must be `<innerModel>`",
                label=did_you_mean(root.tag.text, ["innerModel"]),
                help=f"this is {other}" if other else "",
            )
            return ()
        read_values(root, InnerModelTag(Node, {}), self.report)
        return self._inside(root, depth)

    def _inside(self, element: Element, depth: int) -> tuple[Node, ...]:
        nodes: list[Node] = []
        for child in element.children:
            name = child.tag.text.lower()
            if len(self.ids) > MAX_NODES:
                message = f"there are more than {MAX_NODES} nodes; the rest is left out"
                self.report.add(codes.INNERMODEL_TOO_LARGE, self.file_span, message)
                break
            if name != INCLUDE and name not in TAGS:
                self._unknown(child, name)
            elif self._stands(child, element):
                if name == INCLUDE:
                    nodes.extend(self._include(child, depth))
                else:
                    nodes.append(self._node(child, TAGS[name], name, depth))
        return tuple(nodes)

    def _node(self, element: Element, tag: InnerModelTag, name: str, depth: int) -> Node:
        values = read_values(element, tag, self.report)
        values["id"] = self._id(element, name, str(values.get("id", "")))
        if tag.holds and depth < MAX_DEPTH:
            values["children"] = self._inside(element, depth + 1)
        elif element.children:
            self._misplaced(element, tag)
        return tag.node_class(tag=name, span=element.span, **values)  # type: ignore[arg-type]

    def _id(self, element: Element, name: str, written: str) -> str:
        """The id of a node: as written, or generated to be unique."""
        attribute = element.get("id")
        span = attribute.value.span if attribute else element.tag.span
        if not written:
            if name not in _NAMELESS:
                message = f"`<{element.tag.text}>` has no `id`"
                self.report.add(
                    codes.INNERMODEL_MISSING_ID, span, message, label="nothing can refer to it"
                )
            return self._numbered(name, span, 1)
        first = self.ids.get(written)  # the same span if a file is included twice
        if first is None:
            self.ids[written] = span
            return written
        unique = self._numbered(written, span, 2)
        self.report.add(
            codes.INNERMODEL_DUPLICATE_ID,
            span,
            f"the id `{written:.60}` is not unique",
            label="choose another id",
            notes=(Note(first, "first used here"),),
            help=f"this node is called `{unique:.70}`",
        )
        return unique

    def _numbered(self, base: str, span: Span, first: int) -> str:
        while True:
            number = self.counts.get(base, first)
            self.counts[base] = number + 1
            numbered = f"{base}#{number}"
            if numbered not in self.ids:
                self.ids[numbered] = span
                return numbered

    # -- violations ---------------------------------------------------------------------------

    def _stands(self, element: Element, around: Element) -> bool:
        """Whether an element of a known tag is allowed in `around`; reports it if not."""
        outer, name = around.tag.text.lower(), element.tag.text.lower()
        holds = TAGS[outer].holds if outer in TAGS else True
        inside = TAGS[name].inside if name in TAGS else ()
        if not inside if holds is True else outer in inside:
            return True
        message = f"`<{element.tag.text}>` is not allowed in `<{around.tag.text}>`"
        homes = inside or (name for name, tag in TAGS.items() if tag.holds is True)
        listed = ", ".join(f"`{tag}`" for tag in homes)
        self.report.add(
            codes.INNERMODEL_NESTING, element.tag.span, message, help=f"it is allowed in {listed}"
        )
        return False

    def _unknown(self, element: Element, name: str) -> None:
        span, written = element.tag.span, element.tag.text
        if name == ROOT:
            message = f"`<{written}>` can only be the root element"
            self.report.add(
                codes.INNERMODEL_TAG,
                span,
                message,
                help='to include a file, write `<include path="…"/>`',
            )
            return
        known = [*TAGS, INCLUDE]
        label = did_you_mean(written, known)
        self.report.add(
            codes.INNERMODEL_TAG,
            span,
            f"unknown tag `<{written:.60}>`",
            label=label or "ignored with its content",
            help="" if nearest(written, known) else f"known: {', '.join(known)}",
        )

    def _misplaced(self, element: Element, tag: InnerModelTag) -> None:
        child_span = element.children[0].tag.span
        if tag.holds:
            message = f"elements are nested more than {MAX_DEPTH} deep; the rest is left out"
            self.report.add(codes.INNERMODEL_NESTING, child_span, message)
            return
        message = f"`<{element.tag.text}>` cannot contain other elements"
        holders = ", ".join(f"`{name}`" for name, holder in TAGS.items() if holder.holds is True)
        self.report.add(
            codes.INNERMODEL_NESTING, child_span, message, help=f"elements are allowed in {holders}"
        )

    # -- included files -----------------------------------------------------------------------

    def _include(self, element: Element, depth: int) -> tuple[Node, ...]:
        values = read_values(element, _INCLUDE, self.report)
        attribute = element.get("path")
        if attribute is None or not values["path"]:
            message = "`<include>` needs the `path` of a file"
            self.report.add(codes.INNERMODEL_INCLUDE, element.tag.span, message)
            return ()
        span, written = attribute.value.span, str(values["path"])
        path = self._find(written, span.source)
        if path is None:
            message = f'the included file "{written:.120}" does not exist'
            beside = span.source.path.parent
            self.report.add(
                codes.INNERMODEL_INCLUDE,
                span,
                message,
                help=f"searched as written and in `{beside}`",
            )
            return ()
        return self._included(path, span, depth)

    def _find(self, written: str, source: Source) -> Path | None:
        """Relative to the file; then its last part only, because paths may be of other machines."""
        folder = source.path.parent
        for path in (folder / written, folder / base_name(written)):
            if self.files.exists(path):
                return path
        return None

    def _included(self, path: Path, span: Span, depth: int) -> tuple[Node, ...]:
        key = canonical_path(path)
        if key in self.including:
            message = "the file includes itself"
            if key != self.including[-1]:
                message += " through " + ", ".join(
                    f"`{Path(file).name}`"
                    for file in self.including[self.including.index(key) + 1 :]
                )
            self.report.add(codes.INNERMODEL_INCLUDE, span, message)
            return ()
        try:
            tree = self._tree(path)
        except UnreadableSource as error:
            self.report.add(
                codes.INNERMODEL_INCLUDE, span, f"`{path.name}` cannot be included: {error}"
            )
            return ()
        self.including.append(key)
        nodes = self._document(tree, depth)
        self.including.pop()
        return nodes
