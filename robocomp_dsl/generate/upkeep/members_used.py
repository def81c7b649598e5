"""Parameters and operations that the user's code names, compared with those there are.

In: the user's module. Out: findings about `self.params.x` and
`self.laser_proxy.y` where there is no such parameter or operation.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.generate import codes, names
from robocomp_dsl.generate.component_names import Called
from robocomp_dsl.generate.upkeep.user_module import UserModule
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Kind, Parameter


@dataclass(frozen=True, slots=True)
class _Group:
    """Attributes that an object has; the value is what one of them holds, None for a value."""

    what: str
    attributes: dict[str, _Group | None]
    listed: bool = False


def judge(user: UserModule, component: Component, called: Called, report: Report) -> None:
    """Look through the user's class and its bases in the same file."""
    given = component.parameters.parameters if component.parameters else ()
    known = {"params": _parameters(given)} | _proxies(called)
    for one in user.hierarchy:
        _judge_class(one, user, known, report)


def _parameters(given: Iterable[Parameter], listed: bool = False) -> _Group:
    members = tuple(given)
    called = names.unique([p.name for p in members], names.PARAMETER_MEMBERS | names.ANNOTATION)
    return _Group(
        "parameter",
        {
            name: _parameters(p.members, not p.single) if p.kind is Kind.GROUP else None
            for name, p in zip(called, members, strict=True)
        },
        listed,
    )


def _proxies(called: Called) -> dict[str, _Group]:
    return {
        attribute: _Group(
            "operation",
            dict.fromkeys(called.interfaces[port.interface].methods.values()),
        )
        for port, attribute in called.proxies.items()
    }


def _judge_class(
    one: ast.ClassDef, user: UserModule, known: dict[str, _Group], report: Report
) -> None:
    for node in ast.walk(one):
        if not isinstance(node, ast.Attribute) or node.attr.startswith("_"):
            continue
        group = _group_of(node.value, known)
        if (
            group is None
            or group.listed
            or node.attr in group.attributes
            or node.attr in _MEMBERS[group.what]
        ):
            continue
        end = user.offset(node.end_lineno or node.lineno, node.end_col_offset or 0)
        report.add(
            _CODES[group.what],
            user.source.span(end - len(node.attr), end),
            f"there is no {group.what} `{node.attr}`",
            label=did_you_mean(node.attr, group.attributes),
        )


def _group_of(node: ast.expr, known: dict[str, _Group]) -> _Group | None:
    """What is known of the object that an expression gives: `self.params.motors[0]`."""
    if isinstance(node, ast.Subscript):
        group = _group_of(node.value, known)
        whole = not isinstance(node.slice, ast.Slice)
        return _Group(group.what, group.attributes) if group and group.listed and whole else None
    if not isinstance(node, ast.Attribute):
        return None
    if isinstance(node.value, ast.Name) and node.value.id == "self":
        return known.get(node.attr)
    group = _group_of(node.value, known)
    return group.attributes.get(node.attr) if group and not group.listed else None


_CODES = {"parameter": codes.UNKNOWN_PARAMETER, "operation": codes.UNKNOWN_OPERATION}
_MEMBERS = {
    "parameter": names.PARAMETER_MEMBERS,
    "operation": names.PROXY_MEMBERS | {"query", "command", "publish"},
}
