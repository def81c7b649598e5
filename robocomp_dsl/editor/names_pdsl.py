"""The names in a PDSL file: the parameters, and enumeration values where they are defaults."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.check import check_pdsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import parse_pdsl


def read(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Mention]]:
    """The names in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.files.parse(path, parse_pdsl)
    made = check_pdsl(path, workspace, Report())
    mentions: list[Mention] = []
    if made:
        block = Symbol(made.name, "parameters", made.span, made)
        mentions.append(Mention(made.span, block, declares=True))
        inside = _symbols(made.parameters, made.name)
        mentions += [Mention(one.span, one, declares=True) for one in inside]
    return file.source, file.tree.complete, mentions


def symbol(parameter: Parameter, container: str) -> Symbol:
    """The symbol of a parameter."""
    return Symbol(parameter.name, "parameter", parameter.span, parameter, container)


def _symbols(parameters: Sequence[Parameter], container: str) -> Iterator[Symbol]:
    for one in parameters:
        yield symbol(one, container)
        yield from _symbols(one.members, one.name)
