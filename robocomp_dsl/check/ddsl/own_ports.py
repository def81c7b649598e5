"""`port Laser over ice at "…";` of an instance.

In: the statements and the component. Out: `OwnPort` values, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.check.cdsl.middlewares import find_middleware
from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.check.codes import deployment as deployment_codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import UNPLACED, Instance, OwnPort
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Text


def own_ports_of(
    trees: Sequence[ast.OwnPort],
    component: Component,
    known: KnownMiddlewares,
    report: Report,
) -> tuple[OwnPort, ...]:
    """The valid statements, in order of writing."""
    first: dict[tuple[str, str], Name] = {}
    ports = []
    for tree in trees:
        middleware = find_middleware(tree.over, known, report)
        earlier = first.setdefault((tree.port.text, middleware), tree.port)
        if earlier is not tree.port:
            report_duplicate(tree.port, earlier, "port", report)
            continue
        if _exists(tree.port, component, report) and middleware:
            address = _address(tree.address, middleware, known, report)
            ports.append(OwnPort(tree.port.text, middleware, address))
    return tuple(ports)


def report_shared_addresses(
    instances: Sequence[Instance], trees: Sequence[ast.Instance], report: Report
) -> None:
    """Report two ports that would be reached at the same address of one middleware and host."""
    spans = {
        (tree.name.text, own.port.text): own.address.span
        for tree in trees
        for own in tree.own_ports
        if own.address
    }
    first: dict[tuple[str, str, str], tuple[str, Span]] = {}
    for instance, own in _fixed_ports(instances):
        span = spans.get((instance.name, own.port))
        if span is None or instance.host is UNPLACED:
            continue
        name = f"{instance.name}.{own.port}"
        key = (instance.host.address, own.middleware, own.address)
        earlier, place = first.setdefault(key, (name, span))
        if earlier != name:
            report.add(
                codes.SHARED_ADDRESS,
                span,
                f"`{name}` and `{earlier}` both use the address `{own.address}`",
                notes=[Note(place, "already used here")],
                help="choose another address, or leave it out if no external program needs it",
            )


def _fixed_ports(instances: Sequence[Instance]) -> Iterator[tuple[Instance, OwnPort]]:
    for instance in instances:
        for own in instance.own_ports:
            if own.address:
                yield instance, own


def _exists(name: Name, component: Component, report: Report) -> bool:
    names = [port.name for port in component.ports]
    if name.text in names:
        return True
    if name.text in component.invalid_ports:
        return False
    guess = nearest(name.text, names)
    report.add(
        deployment_codes.UNKNOWN_PORT,
        name.span,
        f"`{component.name}` has no port `{name.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(component.span, f"`{component.name}` is declared here")],
        help="" if guess else f"it has {join_names(names) or 'none'}",
        fix=replace_fix(name.span, guess) if guess else None,
    )
    return False


def _address(written: Text | None, middleware: str, known: KnownMiddlewares, report: Report) -> str:
    """The address of a port; empty if the middleware chooses it."""
    if written is None:
        return ""
    description = known.describe(middleware)
    if not written.value.strip():
        report.add(codes.ADDRESS, written.span, "the address is empty", help="leave out `at`")
        return ""
    if description and not description.capabilities.fixed_address:
        report.add(
            codes.ADDRESS,
            written.span,
            f"ports over `{middleware}` have no address that could be chosen",
            help='leave out `at "…"`',
        )
        return ""
    return written.value.strip()
