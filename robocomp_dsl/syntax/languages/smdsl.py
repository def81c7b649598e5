"""SMDSL: builds the tree of `ast.smdsl`.

In: a source. Out: the tree and syntax diagnostics.
"""

from __future__ import annotations

from typing import Any, ClassVar

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import smdsl as ast
from robocomp_dsl.syntax.ast.base import Duration, Name, Node, Number
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.languages.builder import TIME_UNITS, BlockSetting, Builder, of_kind
from robocomp_dsl.syntax.languages.parse_source import parse_source


def parse(source: Source, report: Report) -> ast.File:
    """The tree of an SMDSL file."""
    file: ast.File = parse_source("smdsl", SmdslBuilder, source, report)
    return file


class DocumentedState(Node):
    """A name in `states`, with the doc comment before it."""

    name: Name
    doc: str


class SmdslBuilder(Builder):
    """Builds the nodes of `ast.smdsl`."""

    ITEM_NAMES: ClassVar = {
        "file_item": "a machine or `:state { … };`",
        "machine_item": "`states`, `initial_state`, `end_state`, `transitions`",
        "transition_item": "`state => state;`",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        machine: ast.Machine | None = None
        for declared in of_kind(ast.Machine, items):
            machine = self._first_machine(machine, declared)
        finished = self.is_complete("state machine")
        return ast.File(span, machine, of_kind(ast.Substates, items), finished)

    def _first_machine(self, first: ast.Machine | None, machine: ast.Machine) -> ast.Machine:
        if first is None:
            return machine
        self.report(
            syntax_codes.DUPLICATE,
            machine.name.span,
            "a file describes one state machine",
            label="this one is ignored",
            notes=(Note(first.name.span, "the first one is here"),),
            help=f"substates are written `:{machine.name.text} {{ … }};`",
        )
        return first

    def machine(self, span: Span, name: Name, *items: Any) -> ast.Machine:
        """`name { … };`."""
        self.has_block = True
        return ast.Machine(span, name, **self._content(span, items))

    def substates(self, span: Span, parent: Name, *items: Any) -> ast.Substates:
        """`:parent parallel { … };`."""
        parallel = bool(items and isinstance(items[0], Name))
        return ast.Substates(span, parent, parallel=parallel, **self._content(span, items))

    def _content(self, span: Span, items: Any) -> dict[str, Any]:
        lists = [item for item in items if isinstance(item, list)]
        states = [s for item in lists for s in item if isinstance(s, DocumentedState)]
        return {
            "states": tuple(state.name for state in states),
            "edges": tuple(e for item in lists for e in item if isinstance(e, ast.Edge)),
            "doc": self.doc(span),
            "state_docs": tuple((state.name.text, state.doc) for state in states if state.doc),
            **self.settings(items),
        }

    def states(self, _span: Span, *names: Any) -> list[DocumentedState]:
        """`states a, b;`."""
        return [
            DocumentedState(name.span, name, self.doc(name.span))
            for name in self.without_trailing_comma(names)
        ]

    def initial_state(self, span: Span, name: Name) -> BlockSetting:
        """`initial_state a;`."""
        return BlockSetting(span, "initial", name)

    def end_state(self, span: Span, name: Name) -> BlockSetting:
        """`end_state a;`."""
        return BlockSetting(span, "end", name)

    def transitions(self, _span: Span, word: Name, *items: Any) -> list[ast.Edge]:
        """`transitions { … };`."""
        if word.text.lower() == "transition":
            self.report(
                legacy_codes.LEGACY_TRANSITIONS,
                word.span,
                f"`{word.text}` is the outdated spelling of `transitions`",
                fix=self.replace_fix("write `transitions`", word.span, "transitions"),
            )
        return list(of_kind(ast.Edge, items))

    def edge(self, span: Span, source: Name, *rest: Any) -> ast.Edge:
        """`a => b, c on event after 2 s;`."""
        *names, event, after = rest
        targets = tuple(self.without_trailing_comma(names))
        return ast.Edge(span, source, targets, event, after, self.doc(span))

    def on(self, _span: Span, name: Name) -> Name:
        """`on found`."""
        return name

    def after(self, span: Span, value: Number, unit: Name) -> Duration:
        """`after 2 s`."""
        known = self.check_choice(unit, TIME_UNITS, "unit of time")
        return Duration(span, value.value * (TIME_UNITS[unit.text.lower()] if known else 1.0))
