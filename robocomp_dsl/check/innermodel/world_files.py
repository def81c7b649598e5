"""The rule for the files of a world: its meshes and pictures exist.

In: a resolved `InnerModel` and where to search. Out: at most one diagnostic, which counts them.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.check.codes import innermodel as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.description.world_files import FileSearch, missing_files
from robocomp_dsl.model.innermodel import InnerModel, Mesh, Node, Plane
from robocomp_dsl.source import Span


def check_world_files(model: InnerModel, folders: Iterable[Path], report: Report) -> None:
    """Report meshes and pictures that are found neither in `folders` nor near the world."""
    search = FileSearch(model.path.parent, tuple(folders))
    meshes, pictures = [], []
    spans = {}
    for node, _ in model.nodes():
        if isinstance(node, Mesh) and node.file:
            meshes.append((node.id, str(search.find(_written(node, node.file)))))
        elif isinstance(node, Plane) and node.texture and not node.texture.startswith("#"):
            pictures.append((node.id, str(search.find(_written(node, node.texture)))))
        spans[node.id] = node.span
    if missing := missing_files(meshes, pictures):
        place = _tag(spans[missing.first])
        report.add(codes.MISSING_WORLD_FILE, place, missing.message, help=missing.help(search))


def _written(node: Node, file: str) -> Path:
    """The path as RoboComp takes it: relative to the file with the node."""
    return node.span.source.path.parent / file


def _tag(span: Span) -> Span:
    """The first line of a node."""
    line = span.source.text.find("\n", span.start, span.end)
    return span.source.span(span.start, span.end if line < 0 else line)
