"""The administrative commands of a port. In: a command as a Bottle. Out: the reply.

The replies are those of YARP 3.5, which its tools compare.
"""

from __future__ import annotations

import os
import platform
import sys
from typing import Any

from robocomp_dsl.runtime.codec.bottle.from_bottle import as_items
from robocomp_dsl.runtime.codec.bottle.values import Bottle, is_word, vocab
from robocomp_dsl.runtime.middleware.yarp.port_protocols import AdministeredPort

_OK, _FAIL = vocab("ok"), vocab("fail")
_COMMANDS = (
    "[help]                  # give this help",
    "[ver]                   # report protocol version information",
    "[add] $portname         # add an output connection",
    "[add] $portname $car    # add an output with a given protocol",
    "[del] $portname         # remove an input or output connection",
    "[list] [in]             # list input connections",
    "[list] [out]            # list output connections",
    "[list] [in]  $portname  # give details for input",
    "[list] [out] $portname  # give details for output",
    "[prop] [get]            # get all user-defined port properties",
    "[prop] [get] $prop      # get a user-defined port property (prop, val)",
    "[prop] [set] $prop $val # set a user-defined port property (prop, val)",
)
MAX_PROPERTIES = 1000


def answer_admin(port: AdministeredPort, command: Bottle) -> list[Any]:
    """The reply of `port` to a command."""
    items = as_items(command)
    word = next((name for name in _ANSWERS if items and is_word(items[0], name)), "")
    if not word:
        return [_FAIL, "send [help] for list of valid commands"]
    return _ANSWERS[word](port, items[1:])


def _help(_port: AdministeredPort, _items: list[Any]) -> list[Any]:
    return [vocab("many"), *_COMMANDS]


def _version(_port: AdministeredPort, _items: list[Any]) -> list[Any]:
    return [vocab("ver"), 1, 2, 3]


def split_target(items: list[Any]) -> tuple[str, str]:
    """Name and carrier of `"tcp://reader"`, `"/reader"`, or `"/reader" tcp`."""
    text = items[0] if items and isinstance(items[0], str) else ""
    chosen = items[1] if len(items) > 1 and isinstance(items[1], str) else ""
    carrier, separator, name = text.partition("://")
    if separator:
        return "/" + name.lstrip("/"), chosen or carrier
    return text, chosen


def _add(port: AdministeredPort, items: list[Any]) -> list[Any]:
    name, carrier = split_target(items)
    shown = items[0] if items else ""
    if port.outputs is None:
        return [-1, f"{port.name} does not write: it has no outputs\r\n"]
    if failure := port.outputs.add(name, carrier or "tcp"):
        return [-1, f"{failure.replace(name, str(shown)) if name else failure}\r\n"]
    return [0, f"Added connection from {port.name} to {shown}\r\n"]


def _delete(port: AdministeredPort, items: list[Any]) -> list[Any]:
    name, _ = split_target(items)
    if port.outputs is not None and port.outputs.remove(name):
        return [0, f"Removed connection from {port.name} to {name}\r\n"]
    if port.disconnect_input(name):
        return [0, f"Removed connection from {name} to {port.name}\r\n"]
    outgoing = f"Could not find an outgoing connection to {name}\r\n"
    return [-1, f"{outgoing}Could not find an incoming connection from {name}\r\n"]


def _list(port: AdministeredPort, items: list[Any]) -> list[Any]:
    if not items:
        return []
    if is_word(items[0], "in"):
        found = port.inputs()
    elif is_word(items[0], "out"):
        found = port.outputs.carriers() if port.outputs else {}
    else:
        return []
    if len(items) == 1:
        return list(found)
    name = items[1] if isinstance(items[1], str) else ""
    if name not in found:
        return []
    ends = [port.name, name] if is_word(items[0], "out") else [name, port.name]
    return [["from", ends[0]], ["to", ends[1]], ["carrier", found[name]]]


def _property(port: AdministeredPort, items: list[Any]) -> list[Any]:
    if items and is_word(items[0], "get"):
        return _get_property(port, items[1:])
    if len(items) > 2 and is_word(items[0], "set") and isinstance(items[1], str):
        if items[1].startswith("/") or len(port.properties) >= MAX_PROPERTIES:
            return [_FAIL, "this port has no priorities, and limits its properties"]
        port.properties[items[1]] = items[2:]
        return [_OK]
    return [_FAIL, "write [prop] [get] key, or [prop] [set] key value"]


def _get_property(port: AdministeredPort, keys: list[Any]) -> list[Any]:
    if not keys:
        return [[key, *value] for key, value in port.properties.items()]
    if keys[0] == port.name:
        return _self(port)
    if isinstance(keys[0], str) and keys[0].startswith("/"):
        return [_FAIL, f"cannot find any connection to/from {keys[0]}"]
    return list(port.properties.get(str(keys[0]), []))


def _self(port: AdministeredPort) -> list[Any]:
    kind = [
        ["is_input", int(port.receiver is not None)],
        ["is_output", int(port.outputs is not None)],
        ["is_rpc", int(port.is_rpc)],
        ["type", ""],
    ]
    process = [["name", sys.argv[0] if sys.argv else ""], ["pid", os.getpid()]]
    system = [["hostname", platform.node()], ["os", platform.system()]]
    return [["process", process], ["platform", system], ["port", kind]]


_ANSWERS = {
    "help": _help,
    "ver": _version,
    "add": _add,
    "del": _delete,
    "list": _list,
    "prop": _property,
}
