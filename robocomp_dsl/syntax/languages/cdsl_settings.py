"""CDSL: builds the settings of a component, including those of older language versions.

In: the rules that the parser recognised. Out: values for the fields of `ast.cdsl.Component`.
"""

from __future__ import annotations

import re
from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Duration, Name, Number, Text
from robocomp_dsl.syntax.ast.cdsl import Gui, StateMachine
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.languages.builder import BlockSetting, Builder

LANGUAGES = ("Cpp", "Cpp11", "Python")
WIDGETS = ("QWidget", "QMainWindow", "QDialog")
OPTIONS = ("agmagent", "InnerModelViewer", "dsr")
_CPP = re.compile(r"(?:c\+\+|cpp|cxx)(\d*)", re.IGNORECASE)


class SettingsBuilder(Builder):
    """The part of the CDSL builder for settings."""

    def language(self, span: Span, name: Name, *plus: Name | Number | None) -> BlockSetting:
        """`language Python;`."""
        suffix = [token for token in plus if token is not None]
        if suffix:
            whole = name.span.cover(suffix[-1].span)
            name = Name(whole, whole.text)
        dialect = _CPP.fullmatch(name.text)
        if name.text.lower() == "android":
            self._without_effect(name.span, "components for Android are no longer generated")
        elif dialect and name.text.lower() not in ("cpp", "cpp11"):
            right = "Cpp11" if dialect[1] else "Cpp"
            self.report(
                syntax_codes.UNKNOWN_CHOICE,
                name.span,
                f"there is no language `{name.text}`",
                label=f"did you mean `{right}`?",
                fix=self.replace_fix(f"write `{right}`", name.span, right),
            )
        else:
            self.check_choice(name, LANGUAGES, "language")
        return BlockSetting(span, "language", name)

    def gui(self, span: Span, first: Name, second: Name | None) -> BlockSetting:
        """`gui Qt(QWidget);`, or the outdated `gui QWidget;` and `gui Qt;`."""
        widget = second or first
        if widget.text.lower() in ("no_gui", "none"):
            return self.no_gui(span)
        toolkit = first if second else None
        if not second and first.text.lower() == "qt":
            self._old_gui(first, "the window class is missing", "QWidget", None)
            return BlockSetting(span, "gui", Gui(span, Name(first.span, "QWidget"), first))
        if toolkit:
            self.check_choice(toolkit, ("Qt",), "toolkit")
        if widget.text == "QFrame":
            self._old_gui(widget, "`QFrame` was replaced by `QWidget`", "QWidget", toolkit)
            widget = Name(widget.span, "QWidget")
        elif self.check_choice(widget, WIDGETS, "window class") and not toolkit:
            self._old_gui(first, "the toolkit is missing", widget.text, toolkit)
        return BlockSetting(span, "gui", Gui(span, widget, toolkit))

    def _old_gui(self, word: Name, message: str, widget: str, toolkit: Name | None) -> None:
        right = widget if toolkit else f"Qt({widget})"
        self.report(
            legacy_codes.LEGACY_GUI,
            word.span,
            message,
            label=f"write `{right}`",
            fix=self.replace_fix(f"write `{right}`", word.span, right),
        )

    def no_gui(self, span: Span) -> BlockSetting:
        """`no_gui;`, which equals omitting `gui`."""
        self._without_effect(span, "omit `gui` for a component without a window")
        return BlockSetting(span, "gui", None)

    def options(self, span: Span, *children: Any) -> BlockSetting:
        """`options agmagent, dsr;`."""
        words = self.without_trailing_comma(children)
        known = tuple(word for word in words if self.check_choice(word, OPTIONS, "option"))
        return BlockSetting(span, "options", known)

    def bare_file(self, span: Span, _name: Name, suffix: Name | None) -> Text:
        """`game` or `game.smdsl` without quotes: syntax of the Eclipse-based version."""
        right = span.text if suffix else f"{span.text}.smdsl"
        self.report(
            legacy_codes.LEGACY_STATEMACHINE,
            span,
            "the file of a state machine is written in quotes",
            label=f'read as "{right}"',
            fix=self.replace_fix("name the file", span, f'"{right}"'),
        )
        return Text(span, right)

    def statemachine(self, span: Span, path: Text, visual: Name | None) -> BlockSetting:
        """`statemachine "x.smdsl" visual;`."""
        return BlockSetting(span, "statemachine", StateMachine(span, path, visual is not None))

    def parameters(self, span: Span, path: Text) -> BlockSetting:
        """`parameters "x.pdsl";`."""
        return BlockSetting(span, "parameters", path)

    def period(self, span: Span, value: Number) -> BlockSetting:
        """`period 20;`."""
        return BlockSetting(span, "period", value)

    def threads(self, span: Span, value: Number) -> BlockSetting:
        """`threads 2;`."""
        return BlockSetting(span, "threads", value)

    def watchdog(self, span: Span, limit: Duration) -> BlockSetting:
        """`watchdog 2 s;`."""
        return BlockSetting(span, "watchdog", limit)

    def middleware(self, span: Span, name: Name) -> BlockSetting:
        """`middleware zenoh;`."""
        return BlockSetting(span, "middleware", name)

    def ignored_setting(self, span: Span, _value: Name) -> None:
        """`useQt qt4;`, `qtversion Qt5;`, `worker isThread;`."""
        self._without_effect(span, f"`{span.text.split()[0]}` no longer has an effect")

    def ignored_section(self, span: Span, *_listed: Any) -> None:
        """`RoboCompClasses { … };`, `RoboCompModules { … };`."""
        word = span.text.partition("{")[0].strip()
        self._without_effect(span, f"`{word}` no longer has an effect")

    def _without_effect(self, span: Span, message: str) -> None:
        self.report(
            legacy_codes.NO_EFFECT,
            span,
            message,
            label="ignored",
            fix=self.replace_fix("delete it", span),
        )
