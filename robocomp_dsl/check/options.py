"""The options of a component: words that stand for imports and ports, or for nothing any more.

In: the options as written. Out: what they add, and findings.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.record import Value
from robocomp_dsl.syntax import ast_cdsl as ast
from robocomp_dsl.syntax.ast_base import Import, Name, QualifiedName, Text

_AGM_IMPORTS = ("AGMExecutive", "AGMCommonBehavior", "AGMWorldModel", "AGMExecutiveTopic")
_AGM_PORTS: tuple[tuple[ast.Role, str], ...] = (
    ("implements", "AGMCommonBehavior"),
    ("requires", "AGMExecutive"),
    ("subscribesTo", "AGMExecutiveTopic"),
)


class Expanded(Value):
    """The imports and ports of a component with what its options add."""

    imports: tuple[Import, ...]
    ports: tuple[ast.Port, ...]


def expand(tree: ast.File, component: ast.Component, report: Report) -> Expanded:
    """Imports and ports with those that an option adds; its word stands for their place."""
    imports, ports = list(tree.imports), list(component.ports)
    for option in component.options:
        if option.text.lower() == "agmagent":
            _add_agm(option, imports, ports)
        else:
            report.add(
                codes.OPTION_WITHOUT_EFFECT,
                option.span,
                f"nothing is generated for the option `{option.text}`",
                help="remove it, or keep it for the older tool",
            )
    return Expanded(tuple(imports), tuple(ports))


def _add_agm(option: Name, imports: list[Import], ports: list[ast.Port]) -> None:
    written = {one.path.value.replace("\\", "/").rpartition("/")[2] for one in imports}
    files = (f"{stem}.idsl" for stem in _AGM_IMPORTS)
    imports.extend(
        Import(option.span, Text(option.span, file)) for file in files if file not in written
    )
    used = {(port.role, port.interface.name.text) for port in ports}
    for role, name in _AGM_PORTS:
        if (role, name) not in used:
            interface = QualifiedName(option.span, Name(option.span, name))
            ports.append(ast.Port(option.span, role, interface))
