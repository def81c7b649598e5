"""Resolves names of middlewares in components, deployments, ports and connections.

In: a name and the known middlewares. Out: the name to use, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Report, nearest
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
    return name or ""


def port_middlewares(
    marks: Sequence[Name], known: KnownMiddlewares, report: Report
) -> tuple[str, ...]:
    """The middlewares of `Laser(zenoh, local)`; those that are not available are left out."""
    return tuple(filter(None, (_port_middleware(mark, known, report) for mark in marks)))


def _port_middleware(mark: Name, known: KnownMiddlewares, report: Report) -> str:
    name = known.find(mark.text)
    if name is None and mark.text.lower() in LEGACY:
        report.add(
            codes.NO_BRIDGE,
            mark.span,
            f"there is no bridge to `{mark.text}` yet: the port uses the component's middleware",
        )
    elif name is None:
        _report_unknown(mark, known, report)
    return name or ""


def _report_unknown(written: Name, known: KnownMiddlewares, report: Report) -> None:
    names = known.names()
    guess = nearest(written.text, names)
    legacy = written.text.lower() in LEGACY
    report.add(
        codes.UNKNOWN_MIDDLEWARE,
        written.span,
        f"there is no bridge to `{written.text}` yet"
        if legacy
        else f"unknown middleware `{written.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"it is one of {join_names(names)}",
        fix=replace_fix(written.span, guess) if guess else None,
    )
