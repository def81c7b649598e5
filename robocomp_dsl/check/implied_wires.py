"""The wires of a deployment that need not be written.

In: instances and the written wires. Out: a wire from each requirement to the only component that
implements it, and from all publishers of a topic to each subscriber that has no written one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.components import Imported
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.wiring import Written, same_interface
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, Instance

End = tuple[Instance, Port]


def implied_wires(
    instances: Sequence[Instance],
    written: Written,
    imported: Imported,
    report: Report,
    *,
    whole: bool,
) -> Iterator[Connection]:
    """The wires that follow. Unless `whole`, an instance is not known: nothing is then missed."""
    wired = {(id(one.source), id(one.source_port)) for one in written.wires}
    wired |= {(id(one.target), id(one.target_port)) for one in written.wires}
    servers = list(_ends(instances, Role.IMPLEMENTS))
    for instance, port in _ends(instances, Role.REQUIRES):
        if (id(instance), id(port)) not in wired:
            found = [end for end in _serving(port, servers) if end[0] is not instance]
            if len(found) == 1:
                yield Connection(instance, port, *found[0], instance.span, implied=True)
            elif instance.name not in written.troubled:
                _judge_requirement((instance, port), found, imported, report, whole=whole)
    publishers = list(_ends(instances, Role.PUBLISHES))
    for instance, port in _ends(instances, Role.SUBSCRIBES):
        if (id(instance), id(port)) not in wired:
            heard = _serving(port, publishers)
            for publisher, topic in heard:
                yield Connection(publisher, topic, instance, port, instance.span, implied=True)
            if not heard and whole:
                _report_unheard(instance, port, report)


def _judge_requirement(
    end: End, found: Sequence[End], imported: Imported, report: Report, *, whole: bool
) -> None:
    if found:
        _report_several(*end, found, report)
    elif whole:
        _report_unserved(*end, imported, report)


def _ends(instances: Sequence[Instance], role: Role) -> Iterator[End]:
    for one in instances:
        for port in one.component.with_role(role):
            yield one, port


def _serving(port: Port, ends: Sequence[End]) -> list[End]:
    return [end for end in ends if same_interface(end[1], port)]


def _report_several(instance: Instance, port: Port, found: Sequence[End], report: Report) -> None:
    names = [f"{one.name}.{other.name}" for one, other in found]
    report.add(
        codes.AMBIGUOUS_REQUIREMENT,
        instance.span,
        f"`{instance.name}` requires `{port.name}`, which {listing(names)} implement",
        notes=[Note(port.span, "it is required here")],
        help=f"say which one: `connect {instance.name}.{port.name} -> {names[0]};`",
    )


def _report_unserved(instance: Instance, port: Port, imported: Imported, report: Report) -> None:
    able = [
        one.name
        for one in imported.components.values()
        if any(same_interface(port, other) for other in one.with_role(Role.IMPLEMENTS))
        and one is not instance.component
    ]
    report.add(
        codes.UNSERVED_REQUIREMENT,
        instance.span,
        f"`{instance.name}` requires `{port.interface.name}`, which no component here implements",
        notes=[Note(port.span, "it is required here")],
        help=f"add one that does: `component {able[0]};`"
        if able
        else f"import a component that implements `{port.interface.name}`, and add it",
    )


def _report_unheard(instance: Instance, port: Port, report: Report) -> None:
    report.add(
        codes.NO_PUBLISHER,
        instance.span,
        f"`{instance.name}` subscribes to `{port.interface.name}`, which nobody here publishes",
        notes=[Note(port.span, "it is subscribed to here")],
    )
