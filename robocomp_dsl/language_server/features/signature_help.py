"""Signature help: the parameters of the function that the cursor is in.

In: a position in a BDSL file. Out: the signature of the innermost call around it, and the number of
the argument.
"""

from __future__ import annotations

import re
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.language_server.completion.complete_bdsl import BUILT_IN_FUNCTIONS
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.signatures.signatures_bdsl import (
    format_function,
    format_parameter,
)
from robocomp_dsl.language_server.symbols.lookup import resolve_position
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_ports import BridgeFunction

TRIGGERS = ["(", ","]

_PART = re.compile(
    r"""//[^\n]*|/\*.*?(?:\*/|\Z)|"[^"\n]*"?|(?P<name>[A-Za-z_]\w*)\s*\(|(?P<sign>[({)},;])""",
    re.DOTALL,
)


def signature_help(session: Session, params: lsp.SignatureHelpParams) -> lsp.SignatureHelp | None:
    """The function around the position; None if there is none."""
    path, offset = resolve_position(session, params.text_document, params.position)
    if path.suffix.lower() != ".bdsl":
        return None
    call = _call_around(session.source(params.text_document.uri).text[:offset])
    if call is None:
        return None
    name, number = call
    function = _functions(session, path).get(name)
    if function is not None:
        information = _information(function)
    elif name in BUILT_IN_FUNCTIONS:
        label, _, text = BUILT_IN_FUNCTIONS[name].partition(": ")
        parameter = lsp.ParameterInformation(label[label.index("(") + 1 : -1])
        information = lsp.SignatureInformation(label, text, [parameter])
    else:
        return None
    return lsp.SignatureHelp([information], active_signature=0, active_parameter=number)


def _call_around(text: str) -> tuple[str, int] | None:
    """The name of the innermost call that is open at the end, and the number of its argument."""
    opened: list[tuple[str, int]] = []
    for part in _PART.finditer(text):
        sign = part["sign"]
        if part["name"]:
            opened.append((part["name"], 0))
        elif sign in ("(", "{"):
            opened.append(("", 0))
        elif sign in (")", "}"):
            del opened[-1:]
        elif sign == ";":
            opened = [item for item in opened if not item[0]]
        elif sign == "," and opened:
            name, number = opened[-1]
            opened[-1] = name, number + 1
    return next((item for item in reversed(opened) if item[0]), None)


def _functions(session: Session, path: Path) -> dict[str, BridgeFunction]:
    checks = session.checks_for_completion(path)
    bridges = [checked.model for checked in checks if isinstance(checked.model, Bridge)]
    return {f.name: f for bridge in reversed(bridges) for f in bridge.functions}


def _information(function: BridgeFunction) -> lsp.SignatureInformation:
    parameters = [
        lsp.ParameterInformation(format_parameter(parameter)) for parameter in function.parameters
    ]
    return lsp.SignatureInformation(format_function(function), function.doc or None, parameters)
