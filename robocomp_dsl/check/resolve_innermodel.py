"""InnerModel, from trees to a body.

In: the path of a file. Out: a `Body` with all that the file includes, always; what could not be
understood is reported and left out, or has its default.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check import codes_body as codes
from robocomp_dsl.check.files import Files, identity
from robocomp_dsl.check.innermodel_tags import INCLUDE, ROOT, TAGS, TEXT, Tag
from robocomp_dsl.check.innermodel_values import read_values
from robocomp_dsl.check.search import base_name
from robocomp_dsl.diagnostics import Note, Report, did_you_mean, nearest
from robocomp_dsl.model.body import Body, Node, Transform
from robocomp_dsl.source import Source, Span, UnreadableSource
from robocomp_dsl.syntax import parse_innermodel
from robocomp_dsl.syntax.ast_innermodel import Element, File

MAX_DEPTH = 200
"""Of nested elements; the deepest robot known has about 60."""

MAX_NODES = 100_000
"""With all that is included; a file of a few lines could include others without end."""

ROOT_ID = "root"
_NAMELESS = ("axes", "taxel")
"""Tags of nodes that nobody refers to."""
_OTHERS = {
    "rcmanager": "a deployment for rcmanager, not a body",
    "agmmodel": "a model of the world for AGM, not a body",
    "scxml": "a state machine: its file is called `.scxml`",
    "robot": "a robot in URDF, not in InnerModel",
    "mujoco": "a model for MuJoCo, not in InnerModel",
}
"""Outermost elements, in lower case, of other files that people have."""
_INCLUDE = Tag(Node, {"path": TEXT})


def resolve_innermodel(path: Path, files: Files, report: Report) -> Body:
    """The body in the file at `path`. Raises `UnreadableSource` for that file only."""
    return _Resolver(files, report).body(path)


def _is_body(root: Element | None) -> bool:
    """Whether the outermost element of a file is that of InnerModel."""
    return root is not None and root.tag.text.lower() == ROOT


@dataclass(slots=True)
class _Resolver:
    files: Files
    report: Report
    ids: dict[str, Span] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    including: list[str] = field(default_factory=list)
    whole: Span = field(init=False)

    def body(self, path: Path) -> Body:
        tree = self._tree(path)
        self.whole = tree.span.source.whole
        self.ids[ROOT_ID] = self.whole
        self.including.append(identity(path))
        found = self._document(tree, 0)
        root = Transform(id=ROOT_ID, tag=ROOT, span=tree.span, children=found)
        return Body(path, root, found=_is_body(tree.root))

    def _tree(self, path: Path) -> File:
        parsed = self.files.parse(path, parse_innermodel)
        self.report.extend(parsed.findings)
        return parsed.tree

    def _document(self, tree: File, depth: int) -> tuple[Node, ...]:
        """What stands in the outermost element of a file."""
        root = tree.root
        if root is None:
            return ()
        if not _is_body(root):
            other = _OTHERS.get(root.tag.text.lower(), "")
            self.report.add(
                codes.BODY_TAG,
                root.tag.span,
                f"the outermost element is `<{root.tag.text}>`, it must be `<innerModel>`",
                label=did_you_mean(root.tag.text, ["innerModel"]),
                help=f"this is {other}" if other else "",
            )
            return ()
        read_values(root, Tag(Node, {}), self.report)
        return self._inside(root, depth)

    def _inside(self, element: Element, depth: int) -> tuple[Node, ...]:
        made: list[Node] = []
        for child in element.children:
            name = child.tag.text.lower()
            if len(self.ids) > MAX_NODES:
                said = f"there are more than {MAX_NODES} nodes; the rest is left out"
                self.report.add(codes.BODY_TOO_LARGE, self.whole, said)
                break
            if name != INCLUDE and name not in TAGS:
                self._unknown(child, name)
            elif self._stands(child, element):
                if name == INCLUDE:
                    made.extend(self._include(child, depth))
                else:
                    made.append(self._node(child, TAGS[name], name, depth))
        return tuple(made)

    def _node(self, element: Element, tag: Tag, name: str, depth: int) -> Node:
        values = read_values(element, tag, self.report)
        values["id"] = self._id(element, name, str(values.get("id", "")))
        if tag.holds and depth < MAX_DEPTH:
            values["children"] = self._inside(element, depth + 1)
        elif element.children:
            self._misplaced(element, tag)
        return tag.made(tag=name, span=element.span, **values)  # type: ignore[arg-type]

    def _id(self, element: Element, name: str, written: str) -> str:
        """The name of a node: as written, or made so that no two are alike."""
        attribute = element.get("id")
        span = attribute.value.span if attribute else element.tag.span
        if not written:
            if name not in _NAMELESS:
                said = f"`<{element.tag.text}>` has no `id`"
                self.report.add(codes.BODY_ID_MISSING, span, said, label="nothing can refer to it")
            return self._numbered(name, span, 1)
        first = self.ids.get(written)  # also this very place, in a file that is included twice
        if first is None:
            self.ids[written] = span
            return written
        made = self._numbered(written, span, 2)
        self.report.add(
            codes.BODY_DUPLICATE,
            span,
            f"the id `{written:.60}` is given twice",
            label="choose another one",
            notes=(Note(first, "first given here"),),
            help=f"until then the node is `{made:.70}`",
        )
        return made

    def _numbered(self, base: str, span: Span, first: int) -> str:
        while True:
            number = self.counts.get(base, first)
            self.counts[base] = number + 1
            made = f"{base}#{number}"
            if made not in self.ids:
                self.ids[made] = span
                return made

    # -- what is not as it should be ----------------------------------------------------------

    def _stands(self, element: Element, around: Element) -> bool:
        """Whether an element of a known tag may stand in `around`; reported if not."""
        outer, name = around.tag.text.lower(), element.tag.text.lower()
        holds = TAGS[outer].holds if outer in TAGS else True
        inside = TAGS[name].inside if name in TAGS else ()
        if not inside if holds is True else outer in inside:
            return True
        said = f"`<{element.tag.text}>` does not stand in `<{around.tag.text}>`"
        homes = inside or (name for name, one in TAGS.items() if one.holds is True)
        listed = ", ".join(f"`{one}`" for one in homes)
        self.report.add(codes.BODY_NESTING, element.tag.span, said, help=f"it stands in {listed}")
        return False

    def _unknown(self, element: Element, name: str) -> None:
        span, written = element.tag.span, element.tag.text
        if name == ROOT:
            said = f"`<{written}>` can only be the outermost element"
            self.report.add(codes.BODY_TAG, span, said, help='another file: `<include path="…"/>`')
            return
        known = [*TAGS, INCLUDE]
        label = did_you_mean(written, known)
        self.report.add(
            codes.BODY_TAG,
            span,
            f"there is no tag `<{written:.60}>`",
            label=label or "it is left out with all that it holds",
            help="" if nearest(written, known) else f"known: {', '.join(known)}",
        )

    def _misplaced(self, element: Element, tag: Tag) -> None:
        at = element.children[0].tag.span
        if tag.holds:
            said = f"elements are nested more than {MAX_DEPTH} deep; the rest is left out"
            self.report.add(codes.BODY_NESTING, at, said)
            return
        said = f"`<{element.tag.text}>` holds no other elements"
        holders = ", ".join(f"`{name}`" for name, one in TAGS.items() if one.holds is True)
        self.report.add(codes.BODY_NESTING, at, said, help=f"those that do are {holders}")

    # -- included files -----------------------------------------------------------------------

    def _include(self, element: Element, depth: int) -> tuple[Node, ...]:
        values = read_values(element, _INCLUDE, self.report)
        attribute = element.get("path")
        if attribute is None or not values["path"]:
            said = "`<include>` needs the `path` of a file"
            self.report.add(codes.BODY_INCLUDE, element.tag.span, said)
            return ()
        span, written = attribute.value.span, str(values["path"])
        path = self._find(written, span.source)
        if path is None:
            said = f'the included file "{written:.120}" is not there'
            beside = span.source.path.parent
            self.report.add(
                codes.BODY_INCLUDE,
                span,
                said,
                help=f"it is looked for as written and in `{beside}`",
            )
            return ()
        return self._included(path, span, depth)

    def _find(self, written: str, source: Source) -> Path | None:
        """As written, beside the file; then by its last part, as paths of other machines need."""
        folder = source.path.parent
        for path in (folder / written, folder / base_name(written)):
            if self.files.exists(path):
                return path
        return None

    def _included(self, path: Path, span: Span, depth: int) -> tuple[Node, ...]:
        key = identity(path)
        if key in self.including:
            said = "the file includes itself"
            if key != self.including[-1]:
                said += " by way of " + ", ".join(
                    f"`{Path(one).name}`" for one in self.including[self.including.index(key) + 1 :]
                )
            self.report.add(codes.BODY_INCLUDE, span, said)
            return ()
        try:
            tree = self._tree(path)
        except UnreadableSource as error:
            self.report.add(codes.BODY_INCLUDE, span, f"`{path.name}` cannot be included: {error}")
            return ()
        self.including.append(key)
        found = self._document(tree, depth)
        self.including.pop()
        return found
