"""Loads modules of the standard library, to see which names they have today."""

from __future__ import annotations

import importlib
import sys
import warnings
from types import ModuleType

_NOT_LOADED = frozenset(("antigravity", "idlelib", "lib2to3", "this", "tkinter", "turtle"))
"""Modules that do something when they are loaded."""


def is_known(module: str) -> bool:
    """Whether `load` may load a module: it is of the standard library, and only has names."""
    top = module.partition(".")[0]
    return top in sys.stdlib_module_names and top not in _NOT_LOADED


def load(module: str) -> ModuleType | None:
    """A known module; None if it does not exist, or is for another system."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return importlib.import_module(module)
        except ImportError:
            return None
