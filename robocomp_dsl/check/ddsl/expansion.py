"""Expands instances of groups: from a definition and the instance to one group.

In: the tree of a group, the definitions. Out: the tree with everything that the definition
contains, what the instance sets, and diagnostics. Settings of an outer group replace those of an
inner one and those of the component.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.check.codes import deployment as deployment_codes
from robocomp_dsl.check.codes import groups as codes
from robocomp_dsl.check.ddsl.definitions import DefinitionFiles
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Node

_INDEX = re.compile(r"\[\d+\]\Z")


def expand(
    group: ast.Group,
    siblings: Mapping[str, Node],
    outer: Sequence[ast.Group],
    definitions: DefinitionFiles,
    report: Report,
) -> tuple[ast.Group, tuple[ast.Group, ...]]:
    """The group with the items of its definition, and the definitions that it follows.

    `siblings` are groups of the same scope; `outer` are the definitions in which the group is.
    """
    if group.definition is None:
        return group, ()
    for what, node in _own_items(group):
        report.add(
            codes.INSTANCE_ITEM,
            node.span,
            f"`{group.name.text}` is an instance of `{group.definition.text}`; it has no {what} of"
            " its own",
            help="write it into the definition, or outside of the group",
        )
    definition = definitions.find(group)
    if definition is None:
        definitions.report_unknown(group, siblings, report)
        return group, ()
    if any(definition is known for known in outer):
        _report_cycle(group, definition, outer, report)
        return group, ()
    if not definitions.may_expand(group, len(outer), report):
        return group, ()
    inner, followed = expand(definition, {}, (*outer, definition), definitions, report)
    if inner.definition is not None and not followed:
        return group, ()  # it has no definition itself, which was reported
    _check_places(group, inner, report)
    return _merge(group, inner), (definition, *followed)


def _own_items(group: ast.Group) -> Iterator[tuple[str, Node]]:
    several: dict[str, Sequence[Node]] = {
        "component": group.instances,
        "group": group.groups,
        "connection": group.connections,
        "arbitration": group.arbitrations,
        "export": group.exports,
    }
    for what, nodes in several.items():
        yield from ((what, node) for node in nodes)


def _merge(group: ast.Group, definition: ast.Group) -> ast.Group:
    return group.replace(
        **_merge_places(group, definition),
        instances=definition.instances,
        connections=definition.connections,
        exports=definition.exports,
        groups=definition.groups,
        arbitrations=definition.arbitrations,
        doc=group.doc or definition.doc,
        settings=_merge_settings(group.settings, definition.settings),
        prefix=group.prefix or definition.prefix,
        inprocess=group.inprocess or definition.inprocess,
        restart=group.restart or definition.restart,
        ready=group.ready or definition.ready,
        memory=group.memory or definition.memory,
        cpu=group.cpu or definition.cpu,
        cores=group.cores or definition.cores,
        realtime=group.realtime or definition.realtime,
    )


def _places(group: ast.Group) -> dict[str, Name | ast.Place]:
    """What a group says about its host, by field."""
    found: dict[str, Name | ast.Place | None] = {
        "host": group.host,
        "label": group.label,
        "place": group.place,
    }
    return {field: node for field, node in found.items() if node is not None}


def _merge_places(group: ast.Group, definition: ast.Group) -> dict[str, Name | ast.Place]:
    return _places(group) or _places(definition)


def _check_places(group: ast.Group, definition: ast.Group, report: Report) -> None:
    """Report an instance on another host than its definition says."""
    own, outer = _places(group), _places(definition)
    if own and outer and own != outer:
        here, there = next(iter(own.values())), next(iter(outer.values()))
        report.add(
            deployment_codes.CONFLICTING_HOSTS,
            here.span,
            f"`{group.name.text}` is assigned to two hosts: by itself and by its definition",
            notes=[Note(there.span, "the host of its definition")],
            help="remove the host from the definition: its instances choose one",
        )


def _merge_settings(
    first: Sequence[ast.Setting], second: Sequence[ast.Setting]
) -> tuple[ast.Setting, ...]:
    """Both, without the settings in `second` that `first` replaces; a list has elements."""
    replaced = {setting.key.text for setting in first}
    rest = (s for s in second if s.key.text not in replaced)
    return (*first, *(s for s in rest if _INDEX.sub("", s.key.text) not in replaced))


def settings_of_members(
    group: ast.Group, outer: Sequence[ast.Setting], members: Mapping[str, Span], report: Report
) -> dict[str, list[ast.Setting]]:
    """The settings of a group and of those around it, by member, with the rest of their keys.

    `members` are the names of the components and groups in the group, and where they are declared.
    `outer` replace those of the group.
    """
    first: dict[str, Name] = {}
    own: list[ast.Setting] = []
    for setting in group.settings:
        earlier = first.setdefault(setting.key.text, setting.key)
        if earlier is setting.key:
            own.append(setting)
        else:
            report_duplicate(setting.key, earlier, "setting", report)
    by_member: dict[str, list[ast.Setting]] = {}
    for setting in _merge_settings(outer, own):
        member, dot, rest = setting.key.text.partition(".")
        if member in members and dot:
            key = setting.key.span
            start = key.start + key.text.index(".") + 1
            inner = Name(key.subspan(start, key.end), rest)
            by_member.setdefault(member, []).append(setting.replace(key=inner))
        else:
            _report_unknown_member(setting.key, member, group, members, report)
    return by_member


def with_settings(instance: ast.Instance, outer: Sequence[ast.Setting]) -> ast.Instance:
    """The instance with the settings of its groups."""
    if not outer:
        return instance
    return instance.replace(settings=_merge_settings(outer, instance.settings))


def _report_unknown_member(
    key: Name, member: str, group: ast.Group, members: Mapping[str, Span], report: Report
) -> None:
    if member in members:
        message = f"`{key.text}` names no parameter"
        help_ = f"write the parameter, too: `set {member}.PARAMETER = …;`"
        report.add(codes.UNKNOWN_MEMBER, key.span, message, help=help_)
        return
    start = key.span.start
    report_unknown_name(
        report,
        codes.UNKNOWN_MEMBER,
        Name(key.span.subspan(start, start + len(member)), member),
        f"there is no component `{member}` in the group `{group.name.text}`",
        members,
        f"it has {join_names(list(members)) or 'none'}: `set COMPONENT.PARAMETER = …;`",
        declared=members.values(),
    )


def _report_cycle(
    group: ast.Group, definition: ast.Group, outer: Sequence[ast.Group], report: Report
) -> None:
    assert group.definition is not None  # noqa: S101 - the caller found the definition
    start = next(i for i, known in enumerate(outer) if known is definition)
    names = [known.name.text for known in outer[start:]]
    shown = " → ".join(f"`{name}`" for name in (*names, definition.name.text))
    report.add(
        codes.DEFINITION_CYCLE,
        group.definition.span,
        f"the definition `{definition.name.text}` contains itself: {shown}",
        notes=[Note(definition.name.span, f"`{definition.name.text}` is defined here")],
        help="remove this instance",
    )
