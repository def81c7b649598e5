"""CDSL: the settings of a component, and those that older generations of the language had.

In: what the parser recognised of a setting. Out: the values for the fields of `ast_cdsl.Component`.
"""

from __future__ import annotations

import re
from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Name, Number, Text
from robocomp_dsl.syntax.ast_cdsl import Gui, StateMachine
from robocomp_dsl.syntax.builder import Builder, Setting

LANGUAGES = ("Cpp", "Cpp11", "Python")
WIDGETS = ("QWidget", "QMainWindow", "QDialog")
OPTIONS = ("agmagent", "InnerModelViewer", "dsr")
_CPP = re.compile(r"(?:c\+\+|cpp|cxx)(\d*)", re.IGNORECASE)


class Settings(Builder):
    """The part of the CDSL builder that is about settings."""

    def language(self, span: Span, name: Name, *plus: Name | Number | None) -> Setting:
        """`language Python;`."""
        behind = [one for one in plus if one is not None]
        if behind:
            whole = name.span.to(behind[-1].span)
            name = Name(whole, whole.text)
        dialect = _CPP.fullmatch(name.text)
        if name.text.lower() == "android":
            self._without_effect(name.span, "components for Android are not generated any more")
        elif dialect and name.text.lower() not in ("cpp", "cpp11"):
            right = "Cpp11" if dialect[1] else "Cpp"
            self.say(
                codes.UNKNOWN_WORD,
                name.span,
                f"there is no language `{name.text}`",
                label=f"did you mean `{right}`?",
                fix=self.rewrite(f"write `{right}`", name.span, right),
            )
        else:
            self.vocabulary(name, LANGUAGES, "language")
        return Setting(span, "language", name)

    def gui(self, span: Span, first: Name, second: Name | None) -> Setting:
        """`gui Qt(QWidget);`, or `gui QWidget;` and `gui Qt;` as it was once written."""
        widget = second or first
        if widget.text.lower() in ("no_gui", "none"):
            return self.no_gui(span)
        toolkit = first if second else None
        if not second and first.text.lower() == "qt":
            self._old_gui(first, "the window class is missing", "QWidget", None)
            return Setting(span, "gui", Gui(span, Name(first.span, "QWidget"), first))
        if toolkit:
            self.vocabulary(toolkit, ("Qt",), "toolkit")
        if widget.text == "QFrame":
            self._old_gui(widget, "`QFrame` became `QWidget`", "QWidget", toolkit)
            widget = Name(widget.span, "QWidget")
        elif self.vocabulary(widget, WIDGETS, "window class") and not toolkit:
            self._old_gui(first, "the toolkit is missing", widget.text, toolkit)
        return Setting(span, "gui", Gui(span, widget, toolkit))

    def _old_gui(self, word: Name, message: str, widget: str, toolkit: Name | None) -> None:
        right = widget if toolkit else f"Qt({widget})"
        self.say(
            codes.LEGACY_GUI,
            word.span,
            message,
            label=f"write `{right}`",
            fix=self.rewrite(f"write `{right}`", word.span, right),
        )

    def no_gui(self, span: Span) -> Setting:
        """`no_gui;`, which is what leaving `gui` out says."""
        self._without_effect(span, "a component without a window has no `gui`")
        return Setting(span, "gui", None)

    def options(self, span: Span, *children: Any) -> Setting:
        """`options agmagent, dsr;`."""
        words = self.without_comma(children)
        known = tuple(word for word in words if self.vocabulary(word, OPTIONS, "option"))
        return Setting(span, "options", known)

    def bare_file(self, span: Span, _name: Name, suffix: Name | None) -> Text:
        """`game` or `game.smdsl` without quotes, as the Eclipse-based generation had it."""
        right = span.text if suffix else f"{span.text}.smdsl"
        self.say(
            codes.LEGACY_STATEMACHINE,
            span,
            "the file of a state machine is named in quotes",
            label=f'read as "{right}"',
            fix=self.rewrite("name the file", span, f'"{right}"'),
        )
        return Text(span, right)

    def statemachine(self, span: Span, path: Text, visual: Name | None) -> Setting:
        """`statemachine "x.smdsl" visual;`."""
        return Setting(span, "statemachine", StateMachine(span, path, visual is not None))

    def parameters(self, span: Span, path: Text) -> Setting:
        """`parameters "x.pdsl";`."""
        return Setting(span, "parameters", path)

    def period(self, span: Span, value: Number) -> Setting:
        """`period 20;`."""
        return Setting(span, "period", value)

    def threads(self, span: Span, value: Number) -> Setting:
        """`threads 2;`."""
        return Setting(span, "threads", value)

    def middleware(self, span: Span, name: Name) -> Setting:
        """`middleware zenoh;`."""
        return Setting(span, "middleware", name)

    def ignored_setting(self, span: Span, _value: Name) -> None:
        """`useQt qt4;`, `qtversion Qt5;`, `worker isThread;`."""
        self._without_effect(span, f"`{span.text.split()[0]}` has no effect any more")

    def ignored_section(self, span: Span, *_listed: Any) -> None:
        """`RoboCompClasses { … };`, `RoboCompModules { … };`."""
        word = span.text.partition("{")[0].strip()
        self._without_effect(span, f"`{word}` has no effect any more")

    def _without_effect(self, span: Span, message: str) -> None:
        self.say(
            codes.NO_EFFECT,
            span,
            message,
            label="ignored",
            fix=self.rewrite("delete it", span),
        )
