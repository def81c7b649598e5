"""The elements of SCXML (W3C recommendation of 1 September 2015): attributes and children.

The table is used for checking and for suggestions.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.record import ValueRecord

NAMESPACE = "http://www.w3.org/2005/07/scxml"


class ScxmlTag(ValueRecord):
    """`text`: whether text content is allowed; `unused`: why the element has no effect, if so.

    The content of an `opaque` element is not checked.
    """

    attributes: tuple[str, ...] = ()
    holds: tuple[str, ...] = ()
    text: bool = False
    opaque: bool = False
    unused: str = ""


STATES = ("state", "parallel", "final", "history")
ACTIONS = ("raise", "if", "foreach", "log", "assign", "script", "send", "cancel")
_WITHIN = ("onentry", "onexit", "transition", "datamodel", "invoke")
_INVOKED = "components do not invoke other machines"

TAGS: Mapping[str, ScxmlTag] = {
    "scxml": ScxmlTag(
        ("initial", "name", "xmlns", "version", "datamodel", "binding", "exmode"),
        ("state", "parallel", "final", "datamodel", "script"),
    ),
    "state": ScxmlTag(("id", "initial"), (*STATES, *_WITHIN, "initial")),
    # Initial states of parallel ones and transitions of final ones are checked with the states.
    "parallel": ScxmlTag(("id", "initial"), ("state", "parallel", "history", *_WITHIN)),
    "final": ScxmlTag(("id",), ("onentry", "onexit", "donedata", "transition")),
    "history": ScxmlTag(("id", "type"), ("transition",)),
    "initial": ScxmlTag((), ("transition",)),
    "transition": ScxmlTag(("event", "cond", "target", "type"), ACTIONS),
    "onentry": ScxmlTag((), ACTIONS),
    "onexit": ScxmlTag((), ACTIONS),
    "datamodel": ScxmlTag((), ("data",)),
    "data": ScxmlTag(("id", "src", "expr"), text=True, opaque=True),
    "raise": ScxmlTag(("event",)),
    "if": ScxmlTag(("cond",), (*ACTIONS, "elseif", "else")),
    "elseif": ScxmlTag(("cond",)),
    "else": ScxmlTag(),
    "foreach": ScxmlTag(("array", "item", "index"), ACTIONS),
    "log": ScxmlTag(("label", "expr")),
    "assign": ScxmlTag(("location", "expr", "attr", "type"), text=True, opaque=True),
    "script": ScxmlTag(("src",), text=True, opaque=True),
    "send": ScxmlTag(
        (
            *("event", "eventexpr", "target", "targetexpr", "type", "typeexpr"),
            *("id", "idlocation", "delay", "delayexpr", "namelist"),
        ),
        ("param", "content"),
    ),
    "cancel": ScxmlTag(("sendid", "sendidexpr")),
    "param": ScxmlTag(("name", "expr", "location")),
    "content": ScxmlTag(("expr",), text=True, opaque=True),
    "donedata": ScxmlTag((), ("param", "content"), unused="the data of a final state is not used"),
    "invoke": ScxmlTag(
        (
            *("type", "typeexpr", "src", "srcexpr", "id", "idlocation"),
            *("namelist", "autoforward"),
        ),
        ("param", "content", "finalize"),
        unused=_INVOKED,
    ),
    "finalize": ScxmlTag((), ACTIONS, unused=_INVOKED),
}
