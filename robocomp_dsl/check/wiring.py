"""The wires of a deployment: those that are written.

In: `connect` lines and instances. Out: `Connection` values, and findings.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.qos import qos_of
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report, nearest
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, Instance
from robocomp_dsl.record import Value
from robocomp_dsl.syntax import ast_ddsl as ast

SOURCES = (Role.REQUIRES, Role.PUBLISHES)
TARGETS = (Role.IMPLEMENTS, Role.SUBSCRIBES)
_FITTING = {Role.REQUIRES: Role.IMPLEMENTS, Role.PUBLISHES: Role.SUBSCRIBES}


class Written(Value):
    """What is connected, and the instances for which something is written that is not right."""

    wires: list[Connection]
    troubled: set[str]


def written_wires(
    trees: Sequence[ast.Connection],
    instances: Mapping[str, Instance],
    troubled: Collection[str],
    report: Report,
) -> Written:
    """The wires that are right, between the known instances; `troubled`: see `Written`."""
    made = Written([], set(troubled))
    for tree in trees:
        one = _wire(tree, instances, report)
        if one is None or _is_second(one, made.wires, report):
            made.troubled.update((tree.source.instance.text, tree.target.instance.text))
        else:
            made.wires.append(one)
    return made


def same_interface(one: Port, other: Port) -> bool:
    """Whether two ports speak of the same interface, be it through two copies of its file."""
    return one.interface.qualified == other.interface.qualified


def _wire(
    tree: ast.Connection, instances: Mapping[str, Instance], report: Report
) -> Connection | None:
    qos = qos_of(tree.qos, report)
    source = instances.get(tree.source.instance.text)
    target = instances.get(tree.target.instance.text)
    if source is None or target is None:
        return None
    if _is_reversed(tree, source, target, report):
        return None
    source_port = _port(tree.source, source, SOURCES, report)
    target_port = _port(tree.target, target, TARGETS, report)
    if source_port is None or target_port is None:
        return None
    if not _fits(tree, source_port, target_port, report):
        return None
    return Connection(source, source_port, target, target_port, tree.span, qos)


def _named(instance: Instance, name: str, roles: tuple[Role, ...]) -> Port | None:
    ports = (one for one in instance.component.ports if one.role in roles)
    return next((one for one in ports if one.name == name), None)


def _is_reversed(tree: ast.Connection, source: Instance, target: Instance, report: Report) -> bool:
    """Whether the wire is written from the server to its client; it is then reported."""
    right = _named(source, tree.source.port.text, SOURCES) and _named(
        target, tree.target.port.text, TARGETS
    )
    turned = _named(source, tree.source.port.text, TARGETS) and _named(
        target, tree.target.port.text, SOURCES
    )
    if right or not turned:
        return False
    edits = (
        Edit(tree.source.span, tree.target.span.text),
        Edit(tree.target.span, tree.source.span.text),
    )
    report.add(
        codes.PORT_ROLE,
        tree.source.span.to(tree.target.span),
        "this connection is written the wrong way round",
        help="it goes from the one that requires or publishes to the one that implements or "
        "subscribes",
        fix=Fix("turn it round", edits),
    )
    return True


def _port(
    tree: ast.PortRef, instance: Instance, roles: tuple[Role, ...], report: Report
) -> Port | None:
    found = _named(instance, tree.port.text, roles)
    if found is not None:
        return found
    source = roles is SOURCES
    wanted = "requires or publishes" if source else "implements or subscribes to"
    other = _named(instance, tree.port.text, (*SOURCES, *TARGETS))
    if other is not None:
        report.add(
            codes.PORT_ROLE,
            tree.port.span,
            f"a connection {'begins' if source else 'ends'} at something that a component {wanted}",
            notes=[Note(other.span, f"`{instance.name}` {other.role} `{other.name}`")],
        )
        return None
    known = [one.name for one in instance.component.ports if one.role in roles]
    guess = nearest(tree.port.text, known)
    report.add(
        codes.UNKNOWN_PORT,
        tree.port.span,
        f"`{instance.name}` has no port `{tree.port.text}` that it {wanted}",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(instance.component.span, f"`{instance.component.name}` is declared here")],
        help="" if guess else f"it has {listing(known) or 'none'}",
        fix=replace(tree.port.span, guess) if guess else None,
    )
    return None


def _fits(tree: ast.Connection, source: Port, target: Port, report: Report) -> bool:
    span = tree.source.span.to(tree.target.span)
    notes = [
        Note(source.span, f"{source.role} `{source.interface.name}`"),
        Note(target.span, f"{target.role} `{target.interface.name}`"),
    ]
    if _FITTING[source.role] is not target.role:
        what = f"`{source.role}` cannot be connected to `{target.role}`"
        right = "connect `requires` to `implements` and `publishes` to `subscribesTo`"
        report.add(codes.PORT_ROLE, span, what, notes=notes, help=right)
        return False
    if not same_interface(source, target):
        what = f"`{source.interface.qualified}` cannot be connected to "
        what += f"`{target.interface.qualified}`"
        report.add(codes.INTERFACES_DIFFER, span, what, notes=notes)
        return False
    return True


def _is_second(wire: Connection, earlier: Sequence[Connection], report: Report) -> bool:
    """Whether the same wire, or another one of the same requirement, was written before."""
    for one in earlier:
        same_source = one.source is wire.source and one.source_port is wire.source_port
        same_target = one.target is wire.target and one.target_port is wire.target_port
        if same_source and (same_target or wire.source_port.role is Role.REQUIRES):
            report.add(
                codes.CONNECTED_TWICE,
                wire.span,
                f"`{wire.source.name}.{wire.source_port.name}` is connected already",
                notes=[Note(one.span, "it is connected here")],
            )
            return True
    return False
