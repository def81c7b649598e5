"""Qualified names, units and doc comments of generated types, which no message needs.

In: `interfaces.json`, which rcgen writes beside `interfaces.py`. Out: texts; empty ones without the
file, as of components that an older version generated.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

Texts = Mapping[str, Any]
_NOTHING: Texts = {}


def documentation_file(module: str) -> Path | None:
    """The file of an imported module; None if the module was not read from a file."""
    path = getattr(sys.modules.get(module), "__file__", None)
    return Path(path).with_suffix(".json") if path else None


class Documentation:
    """What the JSON files tell of types and interfaces.

    `files` are searched for interfaces; the file of a type is beside its module.
    """

    def __init__(self, files: Iterable[Path] = ()) -> None:
        self._interfaces: dict[str, Any] = {}
        for file in files:
            self._interfaces |= _read(file).get("interfaces", _NOTHING)

    def of_type(self, cls: type[Any]) -> Texts:
        """`name`, `doc`, `fields` (name to `unit` and `doc`) and `values` (name to doc)."""
        file = documentation_file(cls.__module__)
        types: Texts = _read(file).get("types", _NOTHING) if file else _NOTHING
        found: Texts = types.get(cls.__name__, _NOTHING)
        return found

    def of_interface(self, name: str) -> Texts:
        """`doc` and `operations` (name to `doc`, `inputs` and `outputs`: name to unit)."""
        found: Texts = self._interfaces.get(name, _NOTHING)
        return found


@cache
def _read(file: Path) -> Texts:
    try:
        texts = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return _NOTHING
    return texts if isinstance(texts, dict) else _NOTHING
