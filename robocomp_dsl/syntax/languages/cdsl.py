"""CDSL: builds the tree of `ast.cdsl`.

In: a source. Out: the tree and syntax diagnostics.
"""

from __future__ import annotations

from typing import Any, ClassVar, cast

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import cdsl as ast
from robocomp_dsl.syntax.ast.base import Import, Name, Node, QualifiedName
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.languages.builder import of_kind
from robocomp_dsl.syntax.languages.cdsl_settings import SettingsBuilder
from robocomp_dsl.syntax.languages.parse_source import parse_source

_ROLES = {role.lower(): role for role in ("implements", "requires", "subscribesTo", "publishes")}


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a CDSL file."""
    file: ast.File = parse_source("cdsl", CdslBuilder, source, report)
    return file


class PortMiddlewares(Node):
    """The mark `(zenoh, local)` of a port."""

    names: tuple[Name, ...]


class CdslBuilder(SettingsBuilder):
    """Builds the nodes of `ast.cdsl`."""

    ITEM_NAMES: ClassVar = {
        "file_item": "`import` or `Component`",
        "component_item": "a section of the component (`Communications`, `language`, `gui`, …)",
        "communications_item": "`implements`, `requires`, `subscribesTo`, `publishes`",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        component: ast.Component | None = None
        for declared in of_kind(ast.Component, items):
            component = self._first_component(component, declared)
        return ast.File(span, of_kind(Import, items), component, self.is_complete("component"))

    def _first_component(
        self, first: ast.Component | None, component: ast.Component
    ) -> ast.Component:
        if first is None:
            return component
        self.report(
            syntax_codes.DUPLICATE,
            component.name.span,
            "a file describes one component",
            label="this one is ignored",
            notes=(Note(first.name.span, "the first one is here"),),
            help="move each component to its own folder and file",
        )
        return first

    def component(self, span: Span, name: Name, *items: Any) -> ast.Component:
        """`Component Name { … };`."""
        self.has_block = True
        lists = [item for item in items if isinstance(item, tuple)]
        if not lists:
            self.report(
                legacy_codes.NO_COMMUNICATIONS,
                name.span,
                f"`{name.text}` has no `Communications` block",
                label="it does not communicate with other components",
            )
        ports = tuple(port for port_list in lists for port in port_list)
        return ast.Component(
            span,
            name,
            ports,
            doc=self.doc(span),
            **self.settings(items),
        )

    def communications(self, _span: Span, *items: Any) -> tuple[ast.Port, ...]:
        """`Communications { … };`."""
        return tuple(port for item in items if item for port in item)

    def outside_communications(
        self, span: Span, ports: tuple[ast.Port, ...]
    ) -> tuple[ast.Port, ...]:
        """`requires Laser;` outside `Communications`."""
        self.report(
            syntax_codes.MISPLACED,
            span,
            "list interfaces in `Communications { … };`",
            fix=self.replace_fix(
                "move it to Communications", span, f"Communications {{ {span.text} }};"
            ),
        )
        return ports

    def ports(self, _span: Span, role: Name, *children: Any) -> tuple[ast.Port, ...]:
        """`requires A, B;`."""
        known = cast("ast.Role", _ROLES[role.text.lower()])
        return tuple(self._with_role(known, port) for port in self.without_trailing_comma(children))

    def _with_role(self, role: ast.Role, port: ast.Port) -> ast.Port:
        """The port with its role. Only required and subscribed ports can be optional."""
        optional = port.optional
        if optional is not None and role in ("implements", "publishes"):
            self.report(
                syntax_codes.MISPLACED,
                optional.span,
                "only `requires` and `subscribesTo` can be `optional`",
                label=f"this component {role} it",
                fix=self.replace_fix("delete it", optional.span),
            )
            optional = None
        return ast.Port(port.span, role, port.interface, port.alias, port.middlewares, optional)

    def no_ports(self, span: Span, role: Name) -> tuple[ast.Port, ...]:
        """`requires;`."""
        self.report(
            legacy_codes.EMPTY_LIST,
            span,
            f"`{role.text}` without an interface",
            fix=self.replace_fix("delete it", span),
        )
        return ()

    def port(self, span: Span, interface: QualifiedName, *options: Any) -> ast.Port:
        """`Laser(ice) as front`, without its role."""
        alias: Name | None = None
        mark: PortMiddlewares | None = None
        optional: Name | None = None
        for option in options:
            if isinstance(option, PortMiddlewares):
                mark = self.first_of(mark, option, "the middleware")
                continue
            kind, name = option
            if kind == "as":
                alias = self.first_of(alias, name, "the instance name")
            else:
                optional = self.first_of(optional, name, "`optional`")
        return ast.Port(span, "requires", interface, alias, mark.names if mark else (), optional)

    def middlewares(self, span: Span, *names: Name) -> PortMiddlewares:
        """`(zenoh, local)`; a repeated name is reported and left out."""
        unique: dict[str, Name] = {}
        for name in self.without_trailing_comma(names):
            first = unique.setdefault(name.text.lower(), name)
            if first is not name:
                self.report(
                    syntax_codes.DUPLICATE,
                    name.span,
                    f"`{name.text}` is written twice",
                    notes=(Note(first.span, "first written here"),),
                )
        return PortMiddlewares(span, tuple(unique.values()))

    def alias(self, _span: Span, name: Name) -> tuple[str, Name]:
        """`as front`."""
        return "as", name

    def optional(self, _span: Span, word: Name) -> tuple[str, Name]:
        """`optional`."""
        return "optional", word
