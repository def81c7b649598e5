"""Expands the options of a component to imports and ports.

In: the options. Out: the imports and ports with those that the options add, and diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.syntax.ast import cdsl as ast
from robocomp_dsl.syntax.ast.base import Import, Name, QualifiedName, Text

_AGM_IMPORTS = ("AGMExecutive", "AGMCommonBehavior", "AGMWorldModel", "AGMExecutiveTopic")
_AGM_PORTS: tuple[tuple[ast.Role, str], ...] = (
    ("implements", "AGMCommonBehavior"),
    ("requires", "AGMExecutive"),
    ("subscribesTo", "AGMExecutiveTopic"),
)


class ExpandedOptions(ValueRecord):
    """The imports and ports of a component including those of its options."""

    imports: tuple[Import, ...]
    ports: tuple[ast.Port, ...]


def expand_options(tree: ast.File, component: ast.Component, report: Report) -> ExpandedOptions:
    """Imports and ports including those of options, which get the span of the option."""
    imports, ports = list(tree.imports), list(component.ports)
    for option in component.options:
        if option.text.lower() == "agmagent":
            _add_agm(option, imports, ports)
        else:
            report.add(
                codes.OPTION_WITHOUT_EFFECT,
                option.span,
                f"the option `{option.text}` has no effect",
                help="remove it, or keep it for the older tool",
            )
    return ExpandedOptions(tuple(imports), tuple(ports))


def _add_agm(option: Name, imports: list[Import], ports: list[ast.Port]) -> None:
    written = {statement.path.value.replace("\\", "/").rpartition("/")[2] for statement in imports}
    files = (f"{stem}.idsl" for stem in _AGM_IMPORTS)
    imports.extend(
        Import(option.span, Text(option.span, file)) for file in files if file not in written
    )
    used = {(port.role, port.interface.name.text) for port in ports}
    for role, name in _AGM_PORTS:
        if (role, name) not in used:
            interface = QualifiedName(option.span, Name(option.span, name))
            ports.append(ast.Port(option.span, role, interface))
