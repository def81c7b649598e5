"""The implicit connections of a deployment.

In: instances, explicit connections, and the exports of groups. Out: a connection from each required
port to the only component that implements it, and from all publishers of a topic to each subscriber
without an explicit connection; diagnostics if there is no unique peer, unless the port is optional.
Components of the same group take precedence, then those with the nearest prefix; other branches of
the namespace are not visible.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.components import ImportedComponents
from robocomp_dsl.check.ddsl.configured_peers import is_configured
from robocomp_dsl.check.ddsl.connections import ExplicitConnections, same_interface
from robocomp_dsl.check.ddsl.prefixes import nearest, on_branch
from robocomp_dsl.check.ddsl.scopes import NAME_SEPARATOR
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, Instance

End = tuple[Instance, Port]
Exports = Mapping[str, Mapping[tuple[str, str], str]]
"""See `groups.visible_exports`."""


def implicit_connections(
    instances: Sequence[Instance],
    written: ExplicitConnections,
    imported: ImportedComponents,
    exports: Exports,
    report: Report,
    *,
    unclear: Collection[str],
    complete: bool,
) -> Iterator[Connection]:
    """The implicit connections. Unless `complete`, missing peers are not reported.

    `unclear` are the names of instances whose component is unknown.
    """
    connected = {
        (id(connection.source), id(connection.source_port)) for connection in written.connections
    }
    connected |= {
        (id(connection.target), id(connection.target_port)) for connection in written.connections
    }
    servers = _EndIndex(_ends(instances, Role.IMPLEMENTS), exports)
    for instance, port in _ends(instances, Role.REQUIRES):
        if (id(instance), id(port)) not in connected:
            found = nearest(instance.prefix, servers.visible(instance, port), _prefix)
            if len(found) == 1:
                yield Connection(instance, port, *found[0], instance.span, implied=True)
            elif not port.optional and not _may_be_connected(instance, found, written, unclear):
                first = _format_end(instance, found[0], exports) if found else ""
                others = servers.others(instance, port)
                candidates = _Candidates(found, others, first)
                _report_requirement(instance, port, candidates, imported, report, whole=complete)
    publishers = _EndIndex(_ends(instances, Role.PUBLISHES), exports, includes_itself=True)
    for instance, port in _ends(instances, Role.SUBSCRIBES):
        if (id(instance), id(port)) not in connected:
            publishers_seen = publishers.visible(instance, port)
            for publisher, topic in publishers_seen:
                yield Connection(publisher, topic, instance, port, instance.span, implied=True)
            is_missing = not publishers_seen and complete and not port.optional
            if is_missing and not is_configured(instance, port):
                others = publishers.others(instance, port)
                _report_no_publisher(instance, port, _other_branches(instance, others), report)


def _may_be_connected(
    instance: Instance, found: Sequence[End], written: ExplicitConnections, unclear: Collection[str]
) -> bool:
    """Whether an error that is reported may hide the server of a required port of `instance`."""
    if written.faulty_instances & {instance.name, *(end.name for end, _ in found)}:
        return True
    groups = {name.rpartition(NAME_SEPARATOR)[0] for name in unclear}
    return instance.group in groups and all(end.group != instance.group for end, _ in found)


@dataclass(frozen=True, slots=True)
class _Candidates:
    """The servers of a required interface: the visible servers, and all; `first` as written."""

    found: Sequence[End]
    all: Sequence[End]
    first: str


def _report_requirement(
    instance: Instance,
    port: Port,
    candidates: _Candidates,
    imported: ImportedComponents,
    report: Report,
    *,
    whole: bool,
) -> None:
    out_of_reach = _other_branches(instance, candidates.all)
    if candidates.found:
        _report_several(instance, port, candidates, report)
    elif out_of_reach:
        _report_other_branches(instance, port, out_of_reach, report)
    elif whole and not is_configured(instance, port):
        _report_no_server(instance, port, imported, report)


def _other_branches(instance: Instance, ends: Sequence[End]) -> list[End]:
    """The ends on other branches of the namespace."""
    return [end for end in ends if not on_branch(instance.prefix, [end], _prefix)]


def _prefix(end: End) -> str:
    return end[0].prefix


class _EndIndex:
    """Ports by interface and by the scope in which they are visible, in their order."""

    def __init__(
        self, ends: Iterable[End], exports: Exports, *, includes_itself: bool = False
    ) -> None:
        self._includes_itself = includes_itself
        self._by_interface: dict[str, list[End]] = {}
        self._visible: dict[tuple[str, str], list[End]] = {}
        scopes: dict[tuple[str, str], list[str]] = {}
        for scope, exported in exports.items():
            for name in exported:
                scopes.setdefault(name, []).append(scope)
        for end in ends:
            instance, port = end
            interface = port.interface.qualified
            self._by_interface.setdefault(interface, []).append(end)
            exporting = scopes.get((instance.name, port.name), ())
            for scope in dict.fromkeys((instance.group, *exporting)):
                self._visible.setdefault((interface, scope), []).append(end)

    def others(self, instance: Instance, port: Port) -> list[End]:
        """All ports with the interface of `port`."""
        return self._others(instance, self._by_interface.get(port.interface.qualified, ()))

    def visible(self, instance: Instance, port: Port) -> list[End]:
        """The ports visible from the innermost group around `instance` that sees any."""
        scope = instance.group
        while True:
            ends = self._visible.get((port.interface.qualified, scope), ())
            found = on_branch(instance.prefix, self._others(instance, ends), _prefix)
            if found or not scope:
                return found
            scope = scope.rpartition(NAME_SEPARATOR)[0]

    def _others(self, instance: Instance, ends: Sequence[End]) -> list[End]:
        return [end for end in ends if self._includes_itself or end[0] is not instance]


def _ends(instances: Sequence[Instance], role: Role) -> Iterator[End]:
    for end in instances:
        for port in end.component.with_role(role):
            yield end, port


def _format_end(instance: Instance, end: End, exports: Exports) -> str:
    """The reference to an end as written in the scope of `instance`."""
    other, port = end
    scope = instance.group
    while other.group != scope:
        found = exports.get(scope, {}).get((other.name, port.name))
        if found or not scope:
            return found or f"{other.name}.{port.name}"
        scope = scope.rpartition(NAME_SEPARATOR)[0]
    return f"{other.name.rpartition(NAME_SEPARATOR)[2]}.{port.name}"


def _report_several(
    instance: Instance, port: Port, candidates: _Candidates, report: Report
) -> None:
    names = [f"{end.name}.{other.name}" for end, other in candidates.found]
    report.add(
        codes.AMBIGUOUS_REQUIREMENT,
        instance.span,
        f"`{instance.name}` requires `{port.name}`, which {join_names(names)} implement",
        notes=[Note(port.span, "required here")],
        help="connect one of them: "
        f"`connect {instance.name.rpartition(NAME_SEPARATOR)[2]}.{port.name} -> "
        f"{candidates.first};`",
    )


def _report_no_server(
    instance: Instance, port: Port, imported: ImportedComponents, report: Report
) -> None:
    able = [
        end.name
        for end in imported.components.values()
        if any(same_interface(port, other) for other in end.with_role(Role.IMPLEMENTS))
        and end is not instance.component
    ]
    report.add(
        codes.UNSATISFIED_REQUIREMENT,
        instance.span,
        f"`{instance.name}` requires `{port.interface.name}`, but no component of this deployment "
        "implements it",
        notes=[Note(port.span, "required here")],
        help=f"add one: `component {able[0]};`"
        if able
        else f"import a component that implements `{port.interface.name}`, and add it",
    )


def _report_other_branches(
    instance: Instance, port: Port, out_of_reach: Sequence[End], report: Report
) -> None:
    other, served = out_of_reach[0]
    ends = (instance.name.rpartition(NAME_SEPARATOR)[2], other.name.rpartition(NAME_SEPARATOR)[2])
    report.add(
        codes.UNSATISFIED_REQUIREMENT,
        instance.span,
        f"`{instance.name}` requires `{port.interface.name}`, but no component under its prefix"
        f" `{instance.prefix}` implements it",
        notes=[Note(port.span, "required here"), *_others(out_of_reach)],
        help=f"connect them: `connect {ends[0]}.{port.name} -> {ends[1]}.{served.name};`",
    )


def _others(out_of_reach: Sequence[End]) -> list[Note]:
    return [
        Note(end.span, f"`{end.name}` is under the prefix `{end.prefix}`")
        for end, _ in out_of_reach
    ]


def _report_no_publisher(
    instance: Instance, port: Port, out_of_reach: Sequence[End], report: Report
) -> None:
    peers = f"no component under its prefix `{instance.prefix}`" if out_of_reach else "no component"
    report.add(
        codes.NO_PUBLISHER,
        instance.span,
        f"`{instance.name}` subscribes to `{port.interface.name}`, but {peers} publishes it",
        notes=[Note(port.span, "subscribed to here"), *_others(out_of_reach)],
    )
