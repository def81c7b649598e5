"""Completion of monitors, arbitration, external programs and ports in DDSL files."""

from __future__ import annotations

import ast as python_ast
from collections.abc import Iterator, Mapping, Sequence

from lsprotocol import types as lsp

from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_idsl import declaration_symbol
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.languages.ddsl_connections import FAILURE_POLICIES, POSITIONS

ROLES = ("IMPLEMENTS", "REQUIRES", "SUBSCRIBES", "PUBLISHES")


def monitor_candidates(
    session: Session, context: CompletionContext
) -> Iterator[CompletionCandidate]:
    """The classes of the file, the positions and the policies of a monitor."""
    last = context.previous_kind
    if last == "STRING":
        yield from value_candidates(*_classes(session, context))
    elif last == "AT":
        yield from value_candidates(*POSITIONS)
    elif last == "FAILURE":
        yield from value_candidates(*FAILURE_POLICIES)


def interface_candidates(components: Mapping[str, Component]) -> Iterator[CompletionCandidate]:
    """The interfaces that components of the deployment use."""
    for component in components.values():
        for port in component.ports:
            interface = port.interface
            yield CompletionCandidate(
                interface.name,
                lsp.CompletionItemKind.Interface,
                interface.qualified,
                declaration_symbol(interface),
            )


def external_names(files: Sequence[ast.File]) -> dict[str, ast.External]:
    """The external programs of all trees, the newest first."""
    return {
        external.name.text: external
        for file in reversed(files)
        for external in (file.deployment.externals if file.deployment else ())
    }


def _classes(session: Session, context: CompletionContext) -> list[str]:
    """The classes in the Python file that the statement names."""
    path = context.path.parent / context.statement[-1].text[1:-1]
    try:
        tree = python_ast.parse(session.files.read(path).text)
    except (UnreadableSource, SyntaxError, ValueError, RecursionError):
        return []
    return [node.name for node in tree.body if isinstance(node, python_ast.ClassDef)]
