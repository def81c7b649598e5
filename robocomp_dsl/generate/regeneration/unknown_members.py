"""Checks the parameters and operations in the user's code against the component.

In: the user's module. Out: findings about `self.params.x` and `self.laser_proxy.y` without such a
parameter or operation.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable

from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.generate import codes, names
from robocomp_dsl.generate.python.component_names import PythonNames
from robocomp_dsl.generate.regeneration.local_names import Names, local_names
from robocomp_dsl.generate.regeneration.python_module import PythonModule
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.record import ValueRecord


class _Group(ValueRecord):
    """Attributes of an object; each maps to the members of its value, None for a plain value."""

    what: str
    attributes: dict[str, _Group | None]
    listed: bool = False

    @property
    def element(self) -> _Group | None:
        """A list of such objects."""
        return _Group(self.what, self.attributes) if self.listed else None

    def has(self, name: str) -> bool:
        """Whether it has an attribute, itself or by its base."""
        return name in self.attributes or name in _MEMBERS[self.what]


def report_unknown_members(
    user: UserModule, component: Component, py_names: PythonNames, report: Report
) -> None:
    """Check the user's class and its bases in the same folder."""
    parameters = component.parameters.parameters if component.parameters else ()
    known = {"params": _parameters(parameters)} | _proxies(py_names)
    for module, class_ in user.hierarchy.classes:
        for statement in class_.body:
            _judge(statement, module, _Scope(known, local_names(statement)), report)


def _parameters(parameters: Iterable[Parameter], listed: bool = False) -> _Group:
    members = tuple(parameters)
    attribute_names = names.unique(
        [p.name for p in members], names.PARAMETER_MEMBERS | names.ANNOTATION
    )
    return _Group(
        "parameter",
        {
            name: _parameters(p.members, not p.single) if p.kind is Kind.GROUP else None
            for name, p in zip(attribute_names, members, strict=True)
        },
        listed,
    )


def _proxies(py_names: PythonNames) -> dict[str, _Group]:
    return {
        attribute: _Group(
            "operation",
            dict.fromkeys(py_names.interfaces[port.interface].methods.values()),
        )
        for port, attribute in py_names.proxies.items()
    }


class _Scope(ValueRecord):
    """The members of the attributes of `self`, and the meaning of local names."""

    known: dict[str, _Group]
    local: Names

    def group_of(self, node: ast.expr) -> _Group | None:
        """The members of the object of an expression: `self.params.motors[0]`."""
        match node:
            case ast.Subscript(value=value, slice=index):
                group = self.group_of(value)
                return group and (group if isinstance(index, ast.Slice) else group.element)
            case ast.Attribute(value=ast.Name(id="self"), attr=name):
                return self.known.get(name)
            case ast.Attribute(value=value, attr=name):
                group = self.group_of(value)
                return group.attributes.get(name) if group and not group.listed else None
            case ast.Name(id=name) if name in self.local:
                return self._of_name(name)
        return None

    def _of_name(self, name: str) -> _Group | None:
        """The meaning of a local name, if all bindings agree."""
        rest = _Scope(self.known, {n: ways for n, ways in self.local.items() if n != name})
        found = [(rest.group_of(binding.value), binding.each) for binding in self.local[name]]
        groups = [group and group.element if each else group for group, each in found]
        return groups[0] if all(binding == groups[0] for binding in groups) else None


def _judge(statement: ast.stmt, module: PythonModule, scope: _Scope, report: Report) -> None:
    for node in ast.walk(statement):
        if not isinstance(node, ast.Attribute) or node.attr.startswith("_"):
            continue
        group = scope.group_of(node.value)
        if group is None or group.listed or group.has(node.attr):
            continue
        end = module.offset(node.end_lineno or node.lineno, node.end_col_offset or 0)
        report.add(
            _CODES[group.what],
            module.source.span(end - len(node.attr), end),
            f"there is no {group.what} `{node.attr}`",
            label=did_you_mean(node.attr, group.attributes),
        )


_CODES = {"parameter": codes.UNKNOWN_PARAMETER, "operation": codes.UNKNOWN_OPERATION}
_MEMBERS = {
    "parameter": names.PARAMETER_MEMBERS,
    "operation": names.PROXY_MEMBERS | {"query", "command", "publish"},
}
