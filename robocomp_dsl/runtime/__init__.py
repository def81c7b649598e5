"""The runtime of components. It loads nothing of the toolchain.

Generated code imports `Component`, its specification and `main` from here, and the types from
`robocomp_dsl.runtime.types`; users extend `Monitor`. They are loaded on first use, because the
toolchain imports the descriptions of middlewares from a subpackage and must start quickly.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robocomp_dsl.runtime.component.component import Component
    from robocomp_dsl.runtime.component.spec import CalledPort, ComponentSpec, ServedPort
    from robocomp_dsl.runtime.connection.message_stamp import (
        MessageStamp,
        message_stamp,
        publishing_stamp,
    )
    from robocomp_dsl.runtime.connection.monitor import Monitor
    from robocomp_dsl.runtime.entry_point import main

__all__ = [
    "CalledPort",
    "Component",
    "ComponentSpec",
    "MessageStamp",
    "Monitor",
    "ServedPort",
    "main",
    "message_stamp",
    "publishing_stamp",
]

_MODULES = {
    "CalledPort": "robocomp_dsl.runtime.component.spec",
    "Component": "robocomp_dsl.runtime.component.component",
    "ComponentSpec": "robocomp_dsl.runtime.component.spec",
    "MessageStamp": "robocomp_dsl.runtime.connection.message_stamp",
    "Monitor": "robocomp_dsl.runtime.connection.monitor",
    "ServedPort": "robocomp_dsl.runtime.component.spec",
    "main": "robocomp_dsl.runtime.entry_point",
    "message_stamp": "robocomp_dsl.runtime.connection.message_stamp",
    "publishing_stamp": "robocomp_dsl.runtime.connection.message_stamp",
}


def __getattr__(name: str) -> object:
    """Load an exported name. Raises `AttributeError`."""
    if name not in _MODULES:
        raise AttributeError(f"module `{__name__}` has no attribute `{name}`")
    value: object = getattr(import_module(_MODULES[name]), name)
    globals()[name] = value
    return value
