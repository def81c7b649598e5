"""The fixes of a finding: its own fix, a suggested name, or missing imports.

In: a finding. Out: fixes. The checks attach a fix if there is exactly one. If a finding has only a
"did you mean" suggestion, or if several files declare a missing name, this module builds the fixes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.names.suggest import add_import, suggest_import
from robocomp_dsl.diagnostics import Diagnostic, Edit, Fix
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_innermodel import elements
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Import, Name, QualifiedName
from robocomp_dsl.syntax.ast.innermodel import File as XmlFile

_SUGGESTION = re.compile(r"did you mean `([^`\n]+)`\?")
"""The text that `did_you_mean` produces."""
_NAME = re.compile(r"(?:([A-Za-z_]\w*)\s*::\s*)?([A-Za-z_]\w*)")


def fixes_for(session: Session, path: Path, finding: Diagnostic) -> Iterator[Fix]:
    """The fixes of `finding`, most likely first. Raises `UnreadableSource`."""
    if finding.fix:
        yield finding.fix
        return
    suggestion = _SUGGESTION.search(finding.label) or _SUGGESTION.search(finding.help)
    if suggestion:
        yield _replacement_fix(session, path, finding.span, suggestion[1])
    yield from _import_fixes(session, path, finding)


def _replacement_fix(session: Session, path: Path, span: Span, word: str) -> Fix:
    """Replace the span by `word`; quotes stay, and a closing tag changes with its opening tag."""
    text = span.text
    quoted = len(text) > 1 and text[0] in "\"'" and text[-1] == text[0]
    inner = span.source.span(span.start + 1, span.end - 1) if quoted else span
    edits = [Edit(inner, word)]
    tree = session.parsed(path).tree
    if isinstance(tree, XmlFile):
        for element in elements(tree.root):
            end = f"</{text}>"
            if element.tag.span == span and element.span.text.endswith(end):
                last = element.span.end - 1
                edits.append(Edit(span.source.span(last - len(text), last), word))
    return Fix(f"change to `{word}`", tuple(edits))


def _import_fixes(session: Session, path: Path, finding: Diagnostic) -> Iterator[Fix]:
    """A fix for every file that declares the missing name."""
    name = _NAME.fullmatch(finding.span.text)
    imports = getattr(session.parsed(path).tree, "imports", None)
    if name is None or "declare it" not in finding.help or path.suffix.lower() == ".ddsl":
        return
    statements: tuple[Import, ...] = imports or ()
    module = Name(finding.span, name[1]) if name[1] else None
    missing = QualifiedName(finding.span, Name(finding.span, name[2]), module)
    workspace = session.workspace
    source = finding.span.source
    offer = suggest_import(
        missing, source, statements, workspace.sources, workspace.import_resolver
    )
    for file in dict.fromkeys(file_path.name for file_path in (offer.paths if offer else ())):
        yield add_import(file, source, statements)
