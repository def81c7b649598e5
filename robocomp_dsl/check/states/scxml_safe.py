"""Checks that a component can run the executable content of an SCXML file.

In: the tree of a file. Out: diagnostics about scripts, files and expressions that the safe mode of
python-statemachine rejects, which components use. The library itself checks the expressions.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

from robocomp_dsl.check.codes import states as codes
from robocomp_dsl.check.states.scxml_syntax import local_name
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.syntax.ast.base import Text
from robocomp_dsl.syntax.ast.innermodel import Element

_VALUES = ("expr", "eventexpr", "targetexpr", "typeexpr", "delayexpr", "sendidexpr", "array")
_DELAY = re.compile(r"\s*(?:\d+\.?\d*|\.\d+)(?:m?s)?\s*")
_HERE = {"", "#_internal", "internal", "#_parent", "parent"}
_WORD = re.compile(r"[^\W\d]\w*")
_NO_FILES = "components do not read files that a state machine names"


def check_runnable(root: Element, report: Report) -> None:
    """Report content that would fail at the start of the component or when it is reached."""
    todo, elements = [root], []
    while todo:
        elements.append(element := todo.pop())
        todo.extend(element.children)
    known = set(_variables(elements))
    for element in elements:
        for place, message, help_text in _violations(element, known):
            report.add(codes.SCXML_UNSAFE, place.span, message, help=help_text)


def _variables(elements: list[Element]) -> Iterator[str]:
    """The variables that the document declares, including those of loops and sent events."""
    for element in elements:
        for name in ("id", "item", "index", "idlocation"):
            if name != "id" or local_name(element) == "data":
                attribute = element.get(name)
                if attribute:
                    yield attribute.value.value.strip()


def _violations(element: Element, known: set[str]) -> Iterator[tuple[Text, str, str]]:
    """The violations of one element: location, message, help."""
    tag = local_name(element)
    if tag == "script":
        place = Text(element.tag.span, "")
        help_text = "move the code to a method of the worker (`on_enter_<state>`)"
        yield place, "components do not run scripts of an SCXML file", help_text
    for attribute in element.attributes:
        name, text = attribute.name.text, attribute.value.value
        if text.strip() and (name == "cond" or name in _VALUES):
            if message := _rejection_reason(text, condition=name == "cond"):
                yield attribute.value, f"this expression is not supported: {message}", _WAY_OUT
        elif name == "src" and tag in ("data", "invoke"):
            yield (
                attribute.value,
                _NO_FILES,
                "write the value into this file" if tag == "data" else "",
            )
        elif name == "delay" and not _DELAY.fullmatch(text):
            yield (
                attribute.value,
                f"`{text:.40}` is not a duration",
                "for example `1.5s` or `200ms`",
            )
        elif name == "target" and tag == "send" and text.strip() not in _HERE:
            yield attribute.value, "events can be sent within the component only", "remove `target`"
        elif name == "location" and tag == "assign":
            word = _WORD.match(text.strip())
            if word is None or word[0] not in known:
                message = f"`{text:.40}` is not declared by a `<data>` element"
                yield (
                    attribute.value,
                    message,
                    'write `<datamodel><data id="…" expr="0"/></datamodel>`',
                )


_WAY_OUT = (
    "expressions may use Python's operators on names, numbers and strings, and `In('state')`; move "
    "other code to a method of the worker"
)


def _rejection_reason(text: str, *, condition: bool) -> str:
    """Why the library rejects an expression; empty if it accepts it."""
    # The import takes 0.1 s and is needed only for files with expressions.
    from statemachine.exceptions import InvalidDefinition  # noqa: PLC0415
    from statemachine.io.evaluators import evaluator_for  # noqa: PLC0415

    evaluator = evaluator_for(trusted=False)
    compiled: Callable[[str], Any] = (
        evaluator.compile_bool if condition else evaluator.compile_value
    )
    try:
        compiled(text)
    except InvalidDefinition as error:
        cause = error.__cause__
        message = getattr(cause, "msg", None) or str(cause or error)
        return message.partition("(<unknown>")[0].strip() or "it is not an expression"
    except (ValueError, SyntaxError, RecursionError, MemoryError, TypeError) as error:
        return str(error) or type(error).__name__
    return ""
