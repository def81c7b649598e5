"""`program` of a deployment: a process that is no component.

In: the tree node. Out: a component without ports that stands for it, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Node


def program_component(tree: ast.Instance, path: Path, report: Report) -> Component:
    """The component that stands for a program. `path` is the DDSL file, whose folder it runs in."""
    if tree.executable is None:
        report.add(
            codes.PROGRAM,
            tree.name.span,
            f"the program `{tree.name.text}` has no command line",
            help='add `executable "camera_server --port 8080";`',
        )
    for what, node in _component_settings(tree):
        report.add(
            codes.PROGRAM,
            node.span,
            f"`{what}` is a setting of components; `{tree.name.text}` is a program",
            help="write what it needs into its command line, or use `env`",
        )
    return Component(tree.name.text, path, tree.name.span, "", (), ())


def _component_settings(tree: ast.Instance) -> Iterator[tuple[str, Node]]:
    single = {
        "config": tree.config,
        "context": tree.context,
        "from": tree.from_,
        "prefix": tree.prefix,
        "port": tree.port,
        "middleware": tree.middleware,
    }
    yield from ((what, node) for what, node in single.items() if node is not None)
    several: dict[str, tuple[Node, ...]] = {
        "set": tree.settings,
        "device": tree.devices,
        "attach": tree.attachments,
        "on": tree.actions,
        "port": tree.own_ports,
    }
    for what, nodes in several.items():
        yield from ((what, node) for node in nodes)
