"""The ways out of a finding: its own fix, the word that was meant, the imports that would help.

In: a finding. Out: fixes. The checks attach a fix where there is one way out; where a finding only
asks "did you mean", or several files declare what is missing, the choice is offered here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.suggest import add_import, offer_import
from robocomp_dsl.diagnostics import Diagnostic, Edit, Fix
from robocomp_dsl.editor.names_innermodel import elements
from robocomp_dsl.editor.session import Session
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast_base import Import, Name, QualifiedName
from robocomp_dsl.syntax.ast_innermodel import File as XmlFile

_MEANT = re.compile(r"did you mean `([^`\n]+)`\?")
"""The label that `did_you_mean` writes."""
_NAME = re.compile(r"(?:([A-Za-z_]\w*)\s*::\s*)?([A-Za-z_]\w*)")


def ways_out(session: Session, path: Path, finding: Diagnostic) -> Iterator[Fix]:
    """The likeliest first. Raises `UnreadableSource`."""
    if finding.fix:
        yield finding.fix
        return
    meant = _MEANT.search(finding.label) or _MEANT.search(finding.help)
    if meant:
        yield _replaced(session, path, finding.span, meant[1])
    yield from _imports(session, path, finding)


def _replaced(session: Session, path: Path, span: Span, word: str) -> Fix:
    """`word` for what stands there; quotes stay, and a closing tag goes with its opening one."""
    text = span.text
    quoted = len(text) > 1 and text[0] in "\"'" and text[-1] == text[0]
    inner = span.source.span(span.start + 1, span.end - 1) if quoted else span
    edits = [Edit(inner, word)]
    tree = session.parsed(path).tree
    if isinstance(tree, XmlFile):
        for one in elements(tree.root):
            end = f"</{text}>"
            if one.tag.span == span and one.span.text.endswith(end):
                last = one.span.end - 1
                edits.append(Edit(span.source.span(last - len(text), last), word))
    return Fix(f"change to `{word}`", tuple(edits))


def _imports(session: Session, path: Path, finding: Diagnostic) -> Iterator[Fix]:
    """One for every file that declares what is missing."""
    name = _NAME.fullmatch(finding.span.text)
    imports = getattr(session.parsed(path).tree, "imports", None)
    if name is None or "declare it" not in finding.help or path.suffix.lower() == ".ddsl":
        return
    statements: tuple[Import, ...] = imports or ()
    module = Name(finding.span, name[1]) if name[1] else None
    asked = QualifiedName(finding.span, Name(finding.span, name[2]), module)
    workspace = session.workspace
    source = finding.span.source
    offer = offer_import(asked, source, statements, workspace.files, workspace.search)
    for file in dict.fromkeys(one.name for one in (offer.paths if offer else ())):
        yield add_import(file, source, statements)
