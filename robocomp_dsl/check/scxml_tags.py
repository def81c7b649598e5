"""The elements of SCXML (W3C recommendation of 1 September 2015): attributes and what they hold.

The one table that reading and did-you-mean share.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.record import Value

NAMESPACE = "http://www.w3.org/2005/07/scxml"


class Tag(Value):
    """`text`: whether words may stand inside; `unused`: why it has no effect here, if it has none.

    A tag that is `opaque` may hold whatever the author likes.
    """

    attributes: tuple[str, ...] = ()
    holds: tuple[str, ...] = ()
    text: bool = False
    opaque: bool = False
    unused: str = ""


STATES = ("state", "parallel", "final", "history")
ACTIONS = ("raise", "if", "foreach", "log", "assign", "script", "send", "cancel")
_WITHIN = ("onentry", "onexit", "transition", "datamodel", "invoke")
_INVOKED = "no other machine is started from within a component"

TAGS: Mapping[str, Tag] = {
    "scxml": Tag(
        ("initial", "name", "xmlns", "version", "datamodel", "binding", "exmode"),
        ("state", "parallel", "final", "datamodel", "script"),
    ),
    "state": Tag(("id", "initial"), (*STATES, *_WITHIN, "initial")),
    # That nothing parallel is the first and that no end is left is judged with the states.
    "parallel": Tag(("id", "initial"), ("state", "parallel", "history", *_WITHIN)),
    "final": Tag(("id",), ("onentry", "onexit", "donedata", "transition")),
    "history": Tag(("id", "type"), ("transition",)),
    "initial": Tag((), ("transition",)),
    "transition": Tag(("event", "cond", "target", "type"), ACTIONS),
    "onentry": Tag((), ACTIONS),
    "onexit": Tag((), ACTIONS),
    "datamodel": Tag((), ("data",)),
    "data": Tag(("id", "src", "expr"), text=True, opaque=True),
    "raise": Tag(("event",)),
    "if": Tag(("cond",), (*ACTIONS, "elseif", "else")),
    "elseif": Tag(("cond",)),
    "else": Tag(),
    "foreach": Tag(("array", "item", "index"), ACTIONS),
    "log": Tag(("label", "expr")),
    "assign": Tag(("location", "expr", "attr", "type"), text=True, opaque=True),
    "script": Tag(("src",), text=True, opaque=True),
    "send": Tag(
        (
            *("event", "eventexpr", "target", "targetexpr", "type", "typeexpr"),
            *("id", "idlocation", "delay", "delayexpr", "namelist"),
        ),
        ("param", "content"),
    ),
    "cancel": Tag(("sendid", "sendidexpr")),
    "param": Tag(("name", "expr", "location")),
    "content": Tag(("expr",), text=True, opaque=True),
    "donedata": Tag((), ("param", "content"), unused="nobody waits for the data of an end"),
    "invoke": Tag(
        (
            *("type", "typeexpr", "src", "srcexpr", "id", "idlocation"),
            *("namelist", "autoforward"),
        ),
        ("param", "content", "finalize"),
        unused=_INVOKED,
    ),
    "finalize": Tag((), ACTIONS, unused=_INVOKED),
}
