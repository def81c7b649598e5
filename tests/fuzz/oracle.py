"""Properties that hold for any file content.

In: a file name's suffix and a text. Out: nothing, or an `AssertionError` that says what is wrong.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from robocomp_dsl.check.languages import CHECKS, PARSERS
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.node import Node
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Lexer
from robocomp_dsl.syntax.grammar.tables import load

HOME = Path("/nonexistent/workspace")
SECONDS = 2.0
"""Of the processor, for an input of some thousand characters: a hundred times what it needs."""
MEANINGLESS = ("void", "T")
"""Words that a tree has no place for: no result, and a flag that says what is so anyway."""
NEIGHBOURS = {
    "Base.idsl": "module RoboCompBase { struct Pose { float x; float y = 0 [mm]; }; };\n",
    "Near.idsl": 'import "Base.idsl"; module Near { interface Near { RoboCompBase::Pose g(); }; };',
    "part.cdsl": 'import "Near.idsl";\nComponent part { Communications { implements Near; }; };\n',
    "part.pdsl": "ComponentParams part { rate float 50 [Hz] 1:1000; };\n",
    "part.smdsl": "part { states a, b; initial_state a; end_state b; transitions { a => b; }; };\n",
}


def assert_properties(suffix: str, text: str) -> None:
    """Parse `text`, and check it in a workspace where it has neighbours."""
    begin = time.process_time()
    assert_tree_is_valid(suffix, text)
    assert_check_is_valid(suffix, text)
    took = time.process_time() - begin
    assert took < SECONDS + len(text) / 20_000, f"{took:.1f} s for {len(text)} characters"


def assert_tree_is_valid(suffix: str, text: str) -> None:
    """A tree whose spans are nested, findings within the text, and no content lost silently."""
    source, report = Source(Path(f"x{suffix}"), text), Report()
    tree = PARSERS[suffix](source, report)
    assert isinstance(tree, Node)
    assert_findings_are_valid(report, {source.path: text})
    outer = {id(tree): (0, len(text))}
    for node in _nodes(tree):
        low, high = outer[id(node)]
        assert low <= node.span.start <= node.span.end <= high, f"{node!r} is not in its parent"
        outer |= {id(child): (node.span.start, node.span.end) for child in _children(node)}
    if not len(report) and suffix in (".idsl", ".cdsl", ".pdsl", ".ddsl", ".smdsl", ".bdsl"):
        _assert_nothing_lost(source, tree)


def assert_check_is_valid(suffix: str, text: str) -> None:
    """All checks of a file among others end without an exception, with findings in place."""
    files = SourceCache()
    texts = {HOME / name: other for name, other in NEIGHBOURS.items()}
    here = HOME / f"x{suffix}"
    texts[here] = text
    for path, diagnostic in texts.items():
        files.set_overlay(path, diagnostic)
    report = Report()
    CHECKS[suffix](here, Workspace((), {}, files=files), report)
    assert_findings_are_valid(report, texts)


def assert_findings_are_valid(report: Report, texts: dict[Path, str]) -> None:
    """Every finding has words, and every place of it is in its file."""
    for diagnostic in report:
        assert diagnostic.message.strip()
        for span in _places(diagnostic):
            size = len(texts.get(span.source.path, span.source.text))
            assert 0 <= span.start <= span.end <= size, f"{diagnostic.message}: {span!r}"
            assert span.start_position <= span.end_position


def _places(diagnostic: Diagnostic) -> Iterator[Span]:
    yield diagnostic.span
    yield from (note.span for note in diagnostic.notes)
    yield from (edit.span for edit in diagnostic.fix.edits) if diagnostic.fix else ()


def _assert_nothing_lost(source: Source, tree: Node) -> None:
    """Every word of the text that is no keyword is in a leaf of the tree."""
    leaves = [n.span for n in _nodes(tree) if n is not tree and not any(_children(n))]
    covered = {at for span in leaves for at in range(span.start, span.end)}
    lexer = Lexer(source, load(source.path.suffix[1:]), FileDiagnostics(source, Report()))
    for token in lexer.tokens():
        if token.kind == END:
            return
        if token.kind == "ID" and token.text not in MEANINGLESS:
            assert token.start in covered, f"`{token.text}` at {token.start} is lost silently"


def _nodes(tree: Node) -> Iterator[Node]:
    todo = [tree]
    while todo:
        node = todo.pop()
        yield node
        todo.extend(_children(node))


def _children(node: Node) -> Iterator[Node]:
    fields: tuple[str, ...] = type(node).__match_args__
    for name in fields:
        yield from _within(getattr(node, name))


def _within(value: Any) -> Iterator[Node]:
    if isinstance(value, Node):
        yield value
    elif isinstance(value, tuple):
        for diagnostic in value:
            yield from _within(diagnostic)
