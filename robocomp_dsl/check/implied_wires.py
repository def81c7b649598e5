"""The wires of a deployment that need not be written.

In: instances, the written wires, and what groups export. Out: a wire from each requirement to the
only component that implements it, and from all publishers of a topic to each subscriber that has no
written one; findings where that cannot be, unless the port is optional. What is in the same group
goes before what is outside of it, and with prefixes what is near; other branches are not seen.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from robocomp_dsl.check import codes
from robocomp_dsl.check.components import Imported
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.prefixes import nearest, on_branch
from robocomp_dsl.check.scopes import JOINT
from robocomp_dsl.check.wiring import Written, same_interface
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, Instance

End = tuple[Instance, Port]
Exports = Mapping[str, Mapping[tuple[str, str], str]]
"""See `groups.seen`."""


def implied_wires(
    instances: Sequence[Instance],
    written: Written,
    imported: Imported,
    exports: Exports,
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
            others = [end for end in _serving(port, servers) if end[0] is not instance]
            found = nearest(instance.prefix, _seen(instance, others, exports), _prefix)
            if len(found) == 1:
                yield Connection(instance, port, *found[0], instance.span, implied=True)
            elif instance.name not in written.troubled and not port.optional:
                first = _shown(instance, found[0], exports) if found else ""
                candidates = _Candidates(found, others, first)
                _judge_requirement(instance, port, candidates, imported, report, whole=whole)
    publishers = list(_ends(instances, Role.PUBLISHES))
    for instance, port in _ends(instances, Role.SUBSCRIBES):
        if (id(instance), id(port)) not in wired:
            others = _serving(port, publishers)
            heard = _seen(instance, others, exports)
            for publisher, topic in heard:
                yield Connection(publisher, topic, instance, port, instance.span, implied=True)
            if not heard and whole and not port.optional:
                _report_unheard(instance, port, _far(instance, others), report)


@dataclass(frozen=True, slots=True)
class _Candidates:
    """Who implements what is required: those that would do, and all; `first` as it is written."""

    found: Sequence[End]
    all: Sequence[End]
    first: str


def _judge_requirement(
    instance: Instance,
    port: Port,
    candidates: _Candidates,
    imported: Imported,
    report: Report,
    *,
    whole: bool,
) -> None:
    far = _far(instance, candidates.all)
    if candidates.found:
        _report_several(instance, port, candidates, report)
    elif far:
        _report_far(instance, port, far, report)
    elif whole:
        _report_unserved(instance, port, imported, report)


def _far(instance: Instance, ends: Sequence[End]) -> list[End]:
    """Those on other branches of names."""
    return [one for one in ends if not on_branch(instance.prefix, [one], _prefix)]


def _prefix(end: End) -> str:
    return end[0].prefix


def _seen(instance: Instance, ends: Sequence[End], exports: Exports) -> list[End]:
    """Those that are seen from the innermost group around `instance` from which any is seen."""
    ends = on_branch(instance.prefix, ends, _prefix)
    scope = instance.group
    while True:
        seen = exports.get(scope, {})
        found = [e for e in ends if e[0].group == scope or (e[0].name, e[1].name) in seen]
        if found or not scope:
            return found
        scope = scope.rpartition(JOINT)[0]


def _ends(instances: Sequence[Instance], role: Role) -> Iterator[End]:
    for one in instances:
        for port in one.component.with_role(role):
            yield one, port


def _serving(port: Port, ends: Sequence[End]) -> list[End]:
    return [end for end in ends if same_interface(end[1], port)]


def _shown(instance: Instance, end: End, exports: Exports) -> str:
    """How an end is written where `instance` is, from where it is seen."""
    other, port = end
    scope = instance.group
    while other.group != scope:
        found = exports.get(scope, {}).get((other.name, port.name))
        if found or not scope:
            return found or f"{other.name}.{port.name}"
        scope = scope.rpartition(JOINT)[0]
    return f"{other.name.rpartition(JOINT)[2]}.{port.name}"


def _report_several(
    instance: Instance, port: Port, candidates: _Candidates, report: Report
) -> None:
    names = [f"{one.name}.{other.name}" for one, other in candidates.found]
    report.add(
        codes.AMBIGUOUS_REQUIREMENT,
        instance.span,
        f"`{instance.name}` requires `{port.name}`, which {listing(names)} implement",
        notes=[Note(port.span, "it is required here")],
        help="say which one: "
        f"`connect {instance.name.rpartition(JOINT)[2]}.{port.name} -> {candidates.first};`",
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


def _report_far(instance: Instance, port: Port, far: Sequence[End], report: Report) -> None:
    other, served = far[0]
    ends = (instance.name.rpartition(JOINT)[2], other.name.rpartition(JOINT)[2])
    report.add(
        codes.UNSERVED_REQUIREMENT,
        instance.span,
        f"`{instance.name}` requires `{port.interface.name}`, which nobody under its prefix"
        f" `{instance.prefix}` implements",
        notes=[Note(port.span, "it is required here"), *_others(far)],
        help=f"say so: `connect {ends[0]}.{port.name} -> {ends[1]}.{served.name};`",
    )


def _others(far: Sequence[End]) -> list[Note]:
    return [Note(one.span, f"`{one.name}` does, under the prefix `{one.prefix}`") for one, _ in far]


def _report_unheard(instance: Instance, port: Port, far: Sequence[End], report: Report) -> None:
    who = f"nobody under its prefix `{instance.prefix}`" if far else "nobody here"
    report.add(
        codes.NO_PUBLISHER,
        instance.span,
        f"`{instance.name}` subscribes to `{port.interface.name}`, which {who} publishes",
        notes=[Note(port.span, "it is subscribed to here"), *_others(far)],
    )
