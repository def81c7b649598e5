"""Indexer of PDSL files: the parameters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.check.passes import check_pdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import parse_pdsl


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.sources.parse(path, parse_pdsl)
    parameters = check_pdsl(path, workspace, Report())
    symbols: list[Symbol] = []
    if parameters:
        symbols.append(Symbol(parameters.name, "parameters", parameters.span, parameters))
        symbols += _symbols(parameters.parameters, parameters.name)
    occurrences = [Occurrence(symbol.span, symbol, declares=True) for symbol in symbols]
    return file.source, file.tree.complete, occurrences


def parameter_symbol(parameter: Parameter, container: str) -> Symbol:
    """The symbol of a parameter."""
    return Symbol(parameter.name, "parameter", parameter.span, parameter, container)


def _symbols(parameters: Sequence[Parameter], container: str) -> Iterator[Symbol]:
    for parameter in parameters:
        yield parameter_symbol(parameter, container)
        yield from _symbols(parameter.members, parameter.name)
