"""Expands the options of a component to imports and ports.

In: the options. Out: the imports and ports with those that the options add, the imported files, and
diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.workspace.loaded import ResolvedImport
from robocomp_dsl.check.workspace.module_loader import ModuleLoader
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.syntax.ast import cdsl as ast
from robocomp_dsl.syntax.ast.base import Import, Name, QualifiedName, Text

_AGM_IMPORTS = ("AGMExecutive", "AGMCommonBehavior", "AGMWorldModel")
_AGM_TOPIC = "AGMExecutiveTopic"
"""In older collections of interfaces, AGMExecutive.idsl declares it, and it has no file."""
_AGM_PORTS: tuple[tuple[ast.Role, str], ...] = (
    ("implements", "AGMCommonBehavior"),
    ("requires", "AGMExecutive"),
    ("subscribesTo", _AGM_TOPIC),
)


class ExpandedOptions(ValueRecord):
    """The imports and ports of a component including those of its options.

    `topic_import` is needed only if no file of `imports` declares the topic of the option.
    """

    imports: tuple[Import, ...]
    ports: tuple[ast.Port, ...]
    topic_import: Import | None = None


def expand_options(tree: ast.File, component: ast.Component, report: Report) -> ExpandedOptions:
    """Imports and ports including those of options, which get the span of the option."""
    imports, ports = list(tree.imports), list(component.ports)
    topic_import = None
    for option in component.options:
        if option.text.lower() == "agmagent":
            topic_import = _add_agm(option, imports, ports)
        else:
            report.add(
                codes.OPTION_WITHOUT_EFFECT,
                option.span,
                f"the option `{option.text}` has no effect",
                help="remove it, or keep it for the older tool",
            )
    return ExpandedOptions(tuple(imports), tuple(ports), topic_import)


def resolve_imports(
    expanded: ExpandedOptions, modules: ModuleLoader, report: Report
) -> list[ResolvedImport]:
    """The files of all imports; failures are reported."""
    links = modules.resolve_imports(expanded.imports, report)
    if expanded.topic_import is None:
        return links
    topic_report = Report()
    topic_links = modules.resolve_imports((expanded.topic_import,), topic_report)
    if topic_links[0].path is None and _declares_topic(links):
        return links
    report.extend(topic_report)
    return [*links, *topic_links]


def _declares_topic(links: list[ResolvedImport]) -> bool:
    modules = (module for link in links if link.loaded for module in link.loaded.modules)
    return any(
        isinstance(declaration, Interface) and declaration.name == _AGM_TOPIC
        for module in modules
        for declaration in module.declarations
    )


def _add_agm(option: Name, imports: list[Import], ports: list[ast.Port]) -> Import | None:
    """Add imports and ports; returns the import of the topic if it is not written."""
    written = {statement.path.value.replace("\\", "/").rpartition("/")[2] for statement in imports}
    topic, *added = (
        None if file in written else Import(option.span, Text(option.span, file))
        for file in (f"{stem}.idsl" for stem in (_AGM_TOPIC, *_AGM_IMPORTS))
    )
    imports.extend(statement for statement in added if statement)
    used = {(port.role, port.interface.name.text) for port in ports}
    for role, name in _AGM_PORTS:
        if (role, name) not in used:
            interface = QualifiedName(option.span, Name(option.span, name))
            ports.append(ast.Port(option.span, role, interface))
    return topic
