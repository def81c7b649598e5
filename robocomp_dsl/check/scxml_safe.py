"""Whether a component can run what an SCXML file computes.

In: the tree of a file. Out: findings about scripts, files and expressions that the safe mode of
python-statemachine, in which components run them, does not take. It judges the expressions itself.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

from robocomp_dsl.check import codes
from robocomp_dsl.check.scxml_form import local
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.syntax.ast_base import Text
from robocomp_dsl.syntax.ast_innermodel import Element

_VALUES = ("expr", "eventexpr", "targetexpr", "typeexpr", "delayexpr", "sendidexpr", "array")
_DELAY = re.compile(r"\s*(?:\d+\.?\d*|\.\d+)(?:m?s)?\s*")
_HERE = {"", "#_internal", "internal", "#_parent", "parent"}
_WORD = re.compile(r"[^\W\d]\w*")
_NO_FILES = "components read no files that a machine names"


def judge_safe(root: Element, report: Report) -> None:
    """Report what would keep the component from starting, or fail when it is reached."""
    todo, every = [root], []
    while todo:
        every.append(element := todo.pop())
        todo.extend(element.children)
    known = set(_variables(every))
    for element in every:
        for place, said, way_out in _wrong(element, known):
            report.add(codes.SCXML_UNSAFE, place.span, said, help=way_out)


def _variables(every: list[Element]) -> Iterator[str]:
    """What the document declares; loops and sent events make variables, too."""
    for element in every:
        for name in ("id", "item", "index", "idlocation"):
            if name != "id" or local(element) == "data":
                given = element.get(name)
                if given:
                    yield given.value.value.strip()


def _wrong(element: Element, known: set[str]) -> Iterator[tuple[Text, str, str]]:
    """What of one element cannot be run: place, words, way out."""
    tag = local(element)
    if tag == "script":
        place = Text(element.tag.span, "")
        way_out = "put the code into a method of the state (`on_enter_<state>`)"
        yield place, "components run no scripts of an SCXML file", way_out
    for one in element.attributes:
        name, text = one.name.text, one.value.value
        if text.strip() and (name == "cond" or name in _VALUES):
            if said := _refused(text, condition=name == "cond"):
                yield one.value, f"this expression cannot be run: {said}", _WAY_OUT
        elif name == "src" and tag in ("data", "invoke"):
            yield one.value, _NO_FILES, "write the value into this file" if tag == "data" else ""
        elif name == "delay" and not _DELAY.fullmatch(text):
            yield one.value, f"`{text:.40}` is no time", "write for instance `1.5s` or `200ms`"
        elif name == "target" and tag == "send" and text.strip() not in _HERE:
            yield one.value, "events are sent within the component only", "leave out `target`"
        elif name == "location" and tag == "assign":
            word = _WORD.match(text.strip())
            if word is None or word[0] not in known:
                said = f"`{text:.40}` is declared by no `<data>`"
                yield one.value, said, 'write `<datamodel><data id="…" expr="0"/></datamodel>`'


_WAY_OUT = (
    "allowed are Python's operators on names, numbers and texts, and `In('state')`; put what needs "
    "more into a method of the state"
)


def _refused(text: str, *, condition: bool) -> str:
    """Why the library does not take an expression; nothing where it does."""
    # 0.1 s to load, and only needed where a file computes something.
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
        said = getattr(cause, "msg", None) or str(cause or error)
        return said.partition("(<unknown>")[0].strip() or "it is no expression"
    except (ValueError, SyntaxError, RecursionError, MemoryError, TypeError) as error:
        return str(error) or type(error).__name__
    return ""
