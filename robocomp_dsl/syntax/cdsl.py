"""CDSL: from text to the tree of `ast_cdsl`.

In: a source. Out: the tree, and findings about its form.
"""

from __future__ import annotations

from typing import Any, ClassVar, cast

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import ast_cdsl as ast
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Import, Name, QualifiedName
from robocomp_dsl.syntax.builder import only
from robocomp_dsl.syntax.cdsl_settings import Settings
from robocomp_dsl.syntax.read import read

_ROLES = {role.lower(): role for role in ("implements", "requires", "subscribesTo", "publishes")}


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a CDSL file."""
    file: ast.File = read("cdsl", CdslBuilder, source, report)
    return file


class CdslBuilder(Settings):
    """Makes the nodes of `ast_cdsl`."""

    ITEMS: ClassVar = {
        "file_item": "`import` or `Component`",
        "component_item": "a section of the component (`Communications`, `language`, `gui`, …)",
        "communications_item": "`implements`, `requires`, `subscribesTo`, `publishes`",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        component: ast.Component | None = None
        for one in only(ast.Component, items):
            component = self._first_component(component, one)
        return ast.File(span, only(Import, items), component, self.finished("component"))

    def _first_component(self, first: ast.Component | None, one: ast.Component) -> ast.Component:
        if first is None:
            return one
        self.say(
            codes.REPEATED,
            one.name.span,
            "a file describes one component",
            label="this one is ignored",
            notes=(Note(first.name.span, "the first one is here"),),
            help="give each component a folder and a file of its own",
        )
        return first

    def component(self, span: Span, name: Name, *items: Any) -> ast.Component:
        """`Component Name { … };`."""
        self.has_block = True
        lists = [item for item in items if isinstance(item, tuple)]
        if not lists:
            self.say(
                codes.NO_COMMUNICATIONS,
                name.span,
                f"`{name.text}` has no Communications",
                label="it will not talk to other components",
            )
        ports = tuple(port for one in lists for port in one)
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
        """`requires Laser;` beside the Communications."""
        self.say(
            codes.MISPLACED,
            span,
            "interfaces are listed in `Communications { … };`",
            fix=self.rewrite(
                "put it into Communications", span, f"Communications {{ {span.text} }};"
            ),
        )
        return ports

    def ports(self, _span: Span, role: Name, *children: Any) -> tuple[ast.Port, ...]:
        """`requires A, B;`."""
        known = cast("ast.Role", _ROLES[role.text.lower()])
        return tuple(self._with_role(known, one) for one in self.without_comma(children))

    def _with_role(self, role: ast.Role, port: ast.Port) -> ast.Port:
        """The port in its list. What a component offers is there: it cannot be optional."""
        optional = port.optional
        if optional is not None and role in ("implements", "publishes"):
            self.say(
                codes.MISPLACED,
                optional.span,
                "only what others offer can be `optional`",
                label=f"this component {role} it",
                fix=self.rewrite("delete it", optional.span),
            )
            optional = None
        return ast.Port(port.span, role, port.interface, port.alias, port.middleware, optional)

    def no_ports(self, span: Span, role: Name) -> tuple[ast.Port, ...]:
        """`requires;`."""
        self.say(
            codes.EMPTY_LIST,
            span,
            f"`{role.text}` lists no interface",
            fix=self.rewrite("delete it", span),
        )
        return ()

    def port(self, span: Span, interface: QualifiedName, *options: Any) -> ast.Port:
        """`Laser(ice) as front`, still without a role."""
        alias: Name | None = None
        middleware: Name | None = None
        optional: Name | None = None
        for kind, name in options:
            if kind == "as":
                alias = self.once(alias, name, "the instance name")
            elif kind == "optional":
                optional = self.once(optional, name, "`optional`")
            else:
                middleware = self.once(middleware, name, "the middleware")
        return ast.Port(span, "requires", interface, alias, middleware, optional)

    def second_middleware(self, _span: Span, name: Name) -> tuple[str, Name]:
        """`(ice)`."""
        return "(", name

    def alias(self, _span: Span, name: Name) -> tuple[str, Name]:
        """`as front`."""
        return "as", name

    def optional(self, _span: Span, word: Name) -> tuple[str, Name]:
        """`optional`."""
        return "optional", word

    def qualified(self, span: Span, first: Name, second: Name | None) -> QualifiedName:
        """`Name` or `Module::Name`."""
        return QualifiedName(span, second, first) if second else QualifiedName(span, first)
