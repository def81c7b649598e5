"""Where components run: `on robot`, `on label gpu` and `place by load`, also of their groups.

In: the scopes and the hosts of a deployment. Out: the place of each instance, and diagnostics. A
group is placed as one: all its components run on the same host.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.codes import placement as placement_codes
from robocomp_dsl.check.ddsl.scopes import DeploymentScope
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import HERE, THIS_MACHINE, UNPLACED, Host
from robocomp_dsl.model.placement import LABEL, LOAD, Placement
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name

_LOCAL = Host(THIS_MACHINE, THIS_MACHINE)


class InstancePlace(Record):
    """The host of an instance, or how it is chosen; `span` is what the file says about it."""

    host: Host = HERE
    placement: Placement = Placement()
    span: Span | None = None


DEFAULT_PLACE = InstancePlace()
"""The place of an instance of which the file says nothing: this machine."""


class _WrittenPlace(Record):
    """What the file says about a component or a group; `unit` is its qualified name."""

    unit: str
    span: Span
    text: str
    host: Name | None = None
    label: Name | None = None
    by_load: ast.Place | None = None


def resolve_places(
    scope: DeploymentScope, hosts: Mapping[str, Host], report: Report
) -> dict[str, InstancePlace]:
    """The places of the instances by qualified name; instances on this machine are missing."""
    written = _written_places(scope, report)
    trees = scope.tree.hosts if isinstance(scope.tree, ast.Deployment) else ()
    labels = [label.span for tree in trees for label in tree.labels]
    resolver = _PlaceResolver(hosts, labels, report)
    resolved = {id(place): resolver.resolve(place) for place in written.values()}
    resolver.report_unused_hosts(scope)
    return {name: resolved[id(place)] for name, place in written.items()}


def _written_places(scope: DeploymentScope, report: Report) -> dict[str, _WrittenPlace]:
    """What is written about each instance, by itself or by its innermost group."""
    groups: dict[str, _WrittenPlace | None] = {}
    places: dict[str, _WrittenPlace] = {}
    for nested in scope.descendants:
        around = groups[nested.outer.path] if nested.outer is not None else None
        if isinstance(nested.tree, ast.Group):
            around = _combined(nested.tree, nested.path, around, report)
        groups[nested.path] = around
        for name, tree in nested.instances.items():
            qualified = nested.qualified_name(name)
            place = _combined(tree, qualified, around, report)
            if place is not None:
                places[qualified] = place
    return places


def _combined(
    tree: ast.Instance | ast.Group, unit: str, around: _WrittenPlace | None, report: Report
) -> _WrittenPlace | None:
    """The place of `tree` in a group with the place `around`."""
    own = _own_place(tree, unit, report)
    if own is None or around is None:
        return own or around
    if own.text != around.text:
        report.add(
            codes.CONFLICTING_HOSTS,
            own.span,
            f"`{tree.name.text}` is assigned to two hosts: `{own.text}`, and with its group "
            f"`{around.text}`",
            notes=[Note(around.span, "the host of its group")],
            help="remove one of the two hosts, or move it out of the group",
        )
    return around


def _own_place(tree: ast.Instance | ast.Group, unit: str, report: Report) -> _WrittenPlace | None:
    places = []
    if tree.host is not None:
        places.append(_WrittenPlace(unit, tree.host.span, tree.host.text, host=tree.host))
    if tree.label is not None:
        text = f"label {tree.label.text}"
        places.append(_WrittenPlace(unit, tree.label.span, text, label=tree.label))
    if tree.place is not None:
        text = " ".join(tree.place.span.text.rstrip("; \t\r\n").split())
        span = tree.place.span
        places.append(_WrittenPlace(unit, span, text, label=tree.place.label, by_load=tree.place))
    if len(places) > 1:
        on = tree.host or tree.label
        report.add(
            placement_codes.PLACED_TWICE,
            places[1].span,
            f"`{tree.name.text}` is placed twice: `on {places[0].text}` and `{places[1].text}`",
            notes=[Note(on.span, "first placed here")] if on else [],
            help="remove one of them; hosts to choose from are written as "
            "`place by load on robot, desk;`",
        )
    return places[0] if places else None


class _PlaceResolver:
    """Resolves the names of hosts and labels, and knows which hosts are used."""

    def __init__(
        self, hosts: Mapping[str, Host], label_spans: Sequence[Span], report: Report
    ) -> None:
        self._hosts = hosts
        self._label_spans = label_spans
        self._report = report
        self._used: set[str] = set()

    def resolve(self, place: _WrittenPlace) -> InstancePlace:
        """The place of one component or group."""
        if place.host is not None:
            return InstancePlace(self._host(place.host) or HERE, Placement(), place.span)
        candidates = tuple(dict.fromkeys(self._candidates(place)))
        if not candidates:
            return InstancePlace(HERE, Placement(), place.span)
        self._used.update(host.name for host in candidates)
        placement = Placement(
            kind=LOAD if place.by_load else LABEL,
            label=place.label.text if place.label else "",
            candidates=tuple(host.name for host in candidates),
            unit=place.unit,
        )
        host = candidates[0] if len(candidates) == 1 else UNPLACED
        return InstancePlace(host, placement, place.span)

    def report_unused_hosts(self, scope: DeploymentScope) -> None:
        """Report hosts on which no component can run; `scope` is that of the deployment."""
        used = {*self._used, *_mentioned_hosts(scope)}
        for host in self._hosts.values():
            if host.name not in used and host.address and host.span is not None:
                self._report.add(
                    placement_codes.UNUSED_HOST,
                    host.span,
                    f"no component runs on the host `{host.name}`",
                    help=f"write `on {host.name}` after the name of a component, or remove the "
                    "host",
                )

    def _candidates(self, place: _WrittenPlace) -> Iterator[Host]:
        if place.label is not None:
            yield from self._with_label(place.label)
        elif place.by_load is not None and place.by_load.hosts:
            for name in place.by_load.hosts:
                if (host := self._host(name)) is not None:
                    yield host
        elif self._hosts:
            yield from self._hosts.values()
        else:
            self._report.add(
                placement_codes.NO_CANDIDATE,
                place.span,
                "`place by load` has no host to choose from: the deployment declares none",
                help='declare them: `host robot { address "10.0.0.2"; };`',
            )

    def _host(self, name: Name) -> Host | None:
        if name.text in self._hosts:
            self._used.add(name.text)
            return self._hosts[name.text]
        if name.text == THIS_MACHINE:
            return _LOCAL
        guess = report_unknown_name(
            self._report,
            codes.UNKNOWN_HOST,
            name,
            f"unknown host `{name.text}`",
            self._hosts,
            f'declare it: `host {name.text} {{ address "10.0.0.2"; }};`',
            declared=[host.span for host in self._hosts.values() if host.span],
        )
        self._used.add(guess)
        return None

    def _with_label(self, label: Name) -> Sequence[Host]:
        matching = [host for host in self._hosts.values() if label.text in host.labels]
        if matching:
            return matching
        known = list(dict.fromkeys(name for h in self._hosts.values() for name in h.labels))
        guess = report_unknown_name(
            self._report,
            placement_codes.UNKNOWN_LABEL,
            label,
            f"no host has the label `{label.text}`",
            known,
            f"the hosts have {join_names(known)}"
            if known
            else f"add it to a host: `labels {label.text};`",
            declared=self._label_spans,
        )
        self._used.update(h.name for h in self._hosts.values() if guess in h.labels)
        return ()


def _mentioned_hosts(scope: DeploymentScope) -> Iterator[str]:
    """The names of hosts in the file, also where another statement decides."""
    for nested in scope.descendants:
        for tree in (nested.tree, *nested.instances.values()):
            if isinstance(tree, ast.Deployment):
                continue
            if tree.host is not None:
                yield tree.host.text
            if tree.place is not None:
                yield from (name.text for name in tree.place.hosts)
