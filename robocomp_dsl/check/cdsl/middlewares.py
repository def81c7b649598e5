"""Resolves names of middlewares in components, deployments, ports and connections.

In: a name and the known middlewares. Out: the name to use, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robocomp_dsl.check.codes import connections as connection_codes
from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.syntax.ast import cdsl as ast
from robocomp_dsl.syntax.ast.base import Name

DEFAULT = "zenoh"
LEGACY = ("ice", "ros", "ros1", "ros2", "yarp", "zmq")
"""Marks of ports in older files, which are accepted where no middleware of the name is known."""


def find_middleware(written: Name | None, known: KnownMiddlewares, report: Report) -> str:
    """The middleware of `middleware …;` or `over …`; empty for none or an unknown one."""
    if written is None:
        return ""
    name = known.find(written.text)
    if name is None:
        _report_unknown(written, known, report)
        return ""
    return _loadable(written, name, known, report)


def _loadable(written: Name, name: str, known: KnownMiddlewares, report: Report) -> str:
    """`name` if its distribution can be loaded; empty otherwise, which is reported."""
    problem = known.problem(name)
    if problem:
        report.add(codes.UNKNOWN_MIDDLEWARE, written.span, problem)
    return "" if problem else name


def port_middlewares(
    marks: Sequence[Name], known: KnownMiddlewares, report: Report
) -> tuple[str, ...]:
    """The middlewares of `Laser(zenoh, local)`; those that are not available are left out."""
    return tuple(filter(None, (_port_middleware(mark, known, report) for mark in marks)))


def check_roles(
    pairs: Iterable[tuple[ast.Port, Port]],
    component: Component,
    known: KnownMiddlewares,
    report: Report,
) -> None:
    """Report ports over a middleware that has no services, or no topics.

    The default middleware has both.
    """
    for tree, port in pairs:
        marks = {known.find(mark.text): mark.span for mark in tree.middlewares}
        for name in port.middlewares or (component.middleware,):
            description = known.describe(name) if name != DEFAULT else None
            if description is None:
                continue
            can = description.capabilities
            if not (can.topics if port.role.is_topic else can.services):
                kind = "topics" if port.role.is_topic else "services"
                report.add(
                    connection_codes.UNSUITABLE_MIDDLEWARE,
                    marks.get(name, tree.interface.span),
                    f"`{name}` has no {kind}: the component {port.role} `{port.interface.name}`",
                    help=f"name another middleware for it: `{port.interface.name}({DEFAULT})`",
                )


def _port_middleware(mark: Name, known: KnownMiddlewares, report: Report) -> str:
    name = known.find(mark.text)
    if name is None and mark.text.lower() in LEGACY:
        meant = [other for other in known.names() if other.startswith(mark.text.lower())]
        report.add(
            codes.NO_BRIDGE,
            mark.span,
            f"there is no middleware `{mark.text}`: the port uses that of the component",
            help=f"name the middleware of its peers: {join_names(meant)}" if meant else "",
        )
    elif name is None:
        _report_unknown(mark, known, report)
    else:
        return _loadable(mark, name, known, report)
    return ""


def _report_unknown(written: Name, known: KnownMiddlewares, report: Report) -> None:
    names = known.names()
    guess = nearest(written.text, names)
    report.add(
        codes.UNKNOWN_MIDDLEWARE,
        written.span,
        f"unknown middleware `{written.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"it is one of {join_names(names)}",
        fix=replace_fix(written.span, guess) if guess else None,
    )
