"""The user's functions of a bridge as methods of the user's class.

In: a bridge and its names. Out: a `Method` for each function, for stubs and regeneration.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.generate import literals
from robocomp_dsl.generate.bridge.bridge_names import BridgeNames
from robocomp_dsl.generate.bridge.methods import function_arguments, function_doc
from robocomp_dsl.generate.python.layout import BODY
from robocomp_dsl.generate.python.worker import HandlerCode
from robocomp_dsl.generate.regeneration.methods import Method, Signature
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_ports import BridgeFunction

_TYPES_MODULE = "rt"


def function_methods(bridge: Bridge, names: BridgeNames) -> dict[str, Method]:
    """All functions by the names of their methods."""
    return {names.variables[f.name]: _method(f, names) for f in bridge.functions}


def _method(function: BridgeFunction, names: BridgeNames) -> Method:
    names.used.clear()
    arguments, returns = function_arguments(function, names)
    name = names.variables[function.name]
    mentioned = sorted(names.used)
    if f"{_TYPES_MODULE}." in " ".join([returns, *(kind for _, kind in arguments)]):
        mentioned.append(_TYPES_MODULE)
    code = HandlerCode(
        name,
        ", ".join(["self", *(f"{a}: {t}" for a, t in arguments)]),
        returns,
        literals.docstring(function_doc(function), BODY),
        ", ".join(a for a, _ in arguments),
        answers=True,
    )
    return Method(
        name,
        Signature(tuple(arguments), returns),
        tuple(mentioned),
        code,
        f"the function `{function.name}`",
        Note(function.span, "declared here"),
        "",
    )
