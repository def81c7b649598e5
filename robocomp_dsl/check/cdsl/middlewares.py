"""Resolves middleware names of components, deployments and ports.

In: a name and the available middlewares. Out: the name to use, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.syntax.ast.base import Name

DEFAULT = "zenoh"
PLANNED = ("ice", "ros", "ros1", "ros2", "yarp", "zmq")
"""Middlewares that the languages accept and this version does not support."""


def component_middleware(written: Name | None, usable: Sequence[str], report: Report) -> str:
    """The middleware of `middleware …;`, or the default."""
    if written is None:
        return DEFAULT
    middleware = _usable(written, usable)
    if middleware is None:
        _report_unknown(written, usable, report)
    return middleware or DEFAULT


def port_middleware(written: Name | None, usable: Sequence[str], report: Report) -> str:
    """The middleware of `Laser(ice)`; empty (that of the component) if it is not available."""
    if written is None:
        return ""
    middleware = _usable(written, usable)
    if middleware is None and written.text.lower() in PLANNED:
        report.add(
            codes.NO_BRIDGE,
            written.span,
            f"there is no bridge to `{written.text}` yet: the port uses the component's middleware",
        )
    elif middleware is None:
        _report_unknown(written, usable, report)
    return middleware or ""


def _usable(written: Name, usable: Sequence[str]) -> str | None:
    return next((name for name in usable if name.lower() == written.text.lower()), None)


def _report_unknown(written: Name, usable: Sequence[str], report: Report) -> None:
    guess = nearest(written.text, usable)
    planned = written.text.lower() in PLANNED
    report.add(
        codes.UNKNOWN_MIDDLEWARE,
        written.span,
        f"there is no bridge to `{written.text}` yet"
        if planned
        else f"unknown middleware `{written.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"it is one of {join_names(usable)}",
        fix=replace_fix(written.span, guess) if guess else None,
    )
