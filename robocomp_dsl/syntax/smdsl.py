"""SMDSL: from text to the tree of `ast_smdsl`.

In: a source. Out: the tree, and findings about its form.
"""

from __future__ import annotations

from typing import Any, ClassVar

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import ast_smdsl as ast
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Duration, Name, Number
from robocomp_dsl.syntax.builder import Builder, Setting, only
from robocomp_dsl.syntax.ddsl_instances import UNITS
from robocomp_dsl.syntax.read import read


def parse(source: Source, report: Report) -> ast.File:
    """The tree of an SMDSL file."""
    file: ast.File = read("smdsl", SmdslBuilder, source, report)
    return file


class SmdslBuilder(Builder):
    """Makes the nodes of `ast_smdsl`."""

    ITEMS_STAND_ALONE: ClassVar = False  # the docs of states are looked up from outside
    ITEMS: ClassVar = {
        "file_item": "a machine or `:state { … };`",
        "machine_item": "`states`, `initial_state`, `end_state`, `transitions`",
        "transition_item": "`state => state;`",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        machine: ast.Machine | None = None
        for one in only(ast.Machine, items):
            machine = self._first_machine(machine, one)
        finished = self.finished("state machine")
        return ast.File(span, machine, only(ast.Substates, items), finished)

    def _first_machine(self, first: ast.Machine | None, one: ast.Machine) -> ast.Machine:
        if first is None:
            return one
        self.say(
            codes.REPEATED,
            one.name.span,
            "a file describes one state machine",
            label="this one is ignored",
            notes=(Note(first.name.span, "the first one is here"),),
            help=f"states inside a state are written `:{one.name.text} {{ … }};`",
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
        lists = [one for one in items if isinstance(one, list)]
        states = tuple(s for one in lists for s in one if isinstance(s, Name))
        starts = [(s.text, s.span.start) for s in states]
        return {
            "states": states,
            "edges": tuple(e for one in lists for e in one if isinstance(e, ast.Edge)),
            "doc": self.doc(span),
            "docs": tuple((name, self.docs[at]) for name, at in starts if at in self.docs),
            **self.settings(items),
        }

    def states(self, _span: Span, *names: Any) -> list[Any]:
        """`states a, b;`."""
        return self.without_comma(names)

    def initial_state(self, span: Span, name: Name) -> Setting:
        """`initial_state a;`."""
        return Setting(span, "initial", name)

    def end_state(self, span: Span, name: Name) -> Setting:
        """`end_state a;`."""
        return Setting(span, "end", name)

    def transitions(self, _span: Span, word: Name, *items: Any) -> list[ast.Edge]:
        """`transitions { … };`."""
        if word.text.lower() == "transition":
            self.say(
                codes.OLD_TRANSITIONS,
                word.span,
                f"`{word.text}` is the old spelling of `transitions`",
                fix=self.rewrite("write `transitions`", word.span, "transitions"),
            )
        return list(only(ast.Edge, items))

    def edge(self, span: Span, source: Name, *rest: Any) -> ast.Edge:
        """`a => b, c on event after 2 s;`."""
        *names, event, after = rest
        targets = tuple(self.without_comma(names))
        return ast.Edge(span, source, targets, event, after, self.doc(span))

    def on(self, _span: Span, name: Name) -> Name:
        """`on found`."""
        return name

    def after(self, span: Span, value: Number, unit: Name) -> Duration:
        """`after 2 s`."""
        known = self.vocabulary(unit, UNITS, "unit of time")
        return Duration(span, value.value * (UNITS[unit.text.lower()] if known else 1.0))
