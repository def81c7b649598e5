"""Names of middlewares, of components, deployments and single ports.

In: a name as written and the names that can be used. Out: the name to use, and findings.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.syntax.ast_base import Name

DEFAULT = "zenoh"
PLANNED = ("ice", "ros", "ros1", "ros2", "yarp", "zmq")
"""Bridges to other worlds that the languages know and this version does not have."""


def middleware_of(written: Name | None, usable: Sequence[str], report: Report) -> str:
    """What `middleware …;` says, or the default."""
    if written is None:
        return DEFAULT
    found = _usable(written, usable)
    if found is None:
        _report_unknown(written, usable, report)
    return found or DEFAULT


def mark_of(written: Name | None, usable: Sequence[str], report: Report) -> str:
    """What `Laser(ice)` says; empty, for the component's own, where that cannot be had."""
    if written is None:
        return ""
    found = _usable(written, usable)
    if found is None and written.text.lower() in PLANNED:
        report.add(
            codes.NO_BRIDGE,
            written.span,
            f"there is no bridge to `{written.text}` yet: the port uses the component's middleware",
        )
    elif found is None:
        _report_unknown(written, usable, report)
    return found or ""


def _usable(written: Name, usable: Sequence[str]) -> str | None:
    return next((one for one in usable if one.lower() == written.text.lower()), None)


def _report_unknown(written: Name, usable: Sequence[str], report: Report) -> None:
    guess = nearest(written.text, usable)
    planned = written.text.lower() in PLANNED
    report.add(
        codes.UNKNOWN_MIDDLEWARE,
        written.span,
        f"there is no bridge to `{written.text}` yet"
        if planned
        else f"there is no middleware `{written.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"it is one of {listing(usable)}",
        fix=replace(written.span, guess) if guess else None,
    )
