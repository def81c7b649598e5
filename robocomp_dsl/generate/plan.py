"""From a model to files. `plan` is pure; `write.py` is the only writer.

In: a resolved component. Out: `OutputFile`s, the same bytes for the same model.
"""

from __future__ import annotations

from importlib import import_module

from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.model.component import Component

__all__ = ["LANGUAGES", "OutputFile", "plan"]

LANGUAGES = {"python": "robocomp_dsl.generate.python.component_files"}
"""Target languages, in lower case, and the module of each, which is loaded on use."""


def plan(component: Component, *, language: str = "", middleware: str = "") -> list[OutputFile]:
    """The files of `component`. `language` and `middleware` override the component's own.

    Raises `KeyError` for a language that is not in `LANGUAGES`.
    """
    target = import_module(LANGUAGES[(language or component.language).lower()])
    files: list[OutputFile] = target.component_files(component, middleware or component.middleware)
    return files
