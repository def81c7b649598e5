"""Faults of one token in real files: deleted, doubled, swapped with the next one, misspelled.

Words beside the fault stay apart: `live; next` with swapped tokens is `live next ;`, since
`livenext ;` would have two faults.

In: files without errors and a random generator. Out: texts with one fault each, and what
`rcgen check` finds in them.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from functools import cache
from itertools import takewhile
from pathlib import Path
from typing import NamedTuple

from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Fix, Report, Severity
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Lexer, Token
from robocomp_dsl.syntax.grammar.tables import load

ROOT = Path(__file__).resolve().parents[1]
SUFFIXES = (".idsl", ".cdsl", ".pdsl", ".ddsl", ".smdsl", ".bdsl")
KINDS = ("delete", "double", "swap", "misspell")
TESTED = ("cases", "golden", "migrate", "middleware")
FOLDERS = ("interfaces", "components", *(f"tests/{name}" for name in TESTED))
FENCE = re.compile(r"^```(idsl|cdsl|pdsl|ddsl|smdsl|bdsl)\n(.*?)^```", re.MULTILINE | re.DOTALL)
WORKSPACE = Workspace(environ={})
"""Keeps the imported files, as in the language server."""

_GLUED = re.compile(r"\w\w|\d\.|\.\d")
_WORD = re.compile(r"[A-Za-z_]\w{2,}", re.ASCII)


class Fault(NamedTuple):
    """A text with one fault of `kind` in the range [start, end) of the text without it."""

    path: Path
    kind: str
    original: str
    text: str
    start: int
    end: int


class Outcome(NamedTuple):
    """What the check of a fault shows: number of errors, and whether the first one helps."""

    errors: int
    near: bool
    restored: bool


def texts(suffix: str) -> Iterator[tuple[Path, str]]:
    """The files and the examples of the documents in a language that have no errors."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob(f"*{suffix}")):
            yield path, path.read_text("utf-8", "replace")
    documents = [*sorted((ROOT / "docs").rglob("*.md")), ROOT / "README.md"]
    for document in documents:
        examples = FENCE.findall(document.read_text("utf-8"))
        for number, (language, text) in enumerate(examples):
            if f".{language}" == suffix:
                yield document.with_name(f"{document.stem}{number}{suffix}"), text


def tokens(text: str, suffix: str) -> list[Token]:
    """The tokens of a text, without the end of the file."""
    source = Source(Path(f"x{suffix}"), text)
    lexer = Lexer(source, load(suffix[1:]), FileDiagnostics(source, Report()))
    return list(takewhile(lambda token: token.kind != END, lexer.tokens()))


def find_errors(path: Path, text: str) -> list[Diagnostic]:
    """The errors that `rcgen check` shows for the text as content of `path`, in its order."""
    report = Report()
    WORKSPACE.sources.set_overlay(path, text)
    try:
        check_file(path, WORKSPACE, report)
    finally:
        WORKSPACE.sources.remove_overlay(path)
    return [d for d in report.sorted() if d.severity is Severity.ERROR]


@cache
def correct_texts(suffix: str) -> list[tuple[Path, str, list[Token]]]:
    """The texts of a language without errors, and their tokens."""
    return [
        (path, text, tokens(text, suffix))
        for path, text in texts(suffix)
        if not find_errors(path, text)
    ]


def faults(suffix: str, kind: str, count: int, rng: random.Random) -> Iterator[Fault]:
    """`count` faults of a kind, at tokens that are equally likely in all texts."""
    candidates = [
        (path, text, found, index)
        for path, text, found in correct_texts(suffix)
        for index in range(len(found) - 1)
    ]
    rng.shuffle(candidates)
    for path, text, found, index in candidates:
        if count == 0:
            return
        fault = make_fault(path, text, found, index, kind, rng)
        if fault:
            count -= 1
            yield fault


def make_fault(
    path: Path, text: str, found: list[Token], index: int, kind: str, rng: random.Random
) -> Fault | None:
    """The fault of a kind at the token `found[index]`; None if it would change nothing."""
    token, following = found[index], found[index + 1]
    start, end, word = token.start, token.end, text[token.start : token.end]
    if kind == "swap":
        end = following.end
        other = text[following.start : end]
        if other == word:
            return None
        changed = _apart(_apart(other, text[token.end : following.start]), word)
    elif kind == "misspell":
        if not _WORD.fullmatch(word):
            return None
        changed = _misspelled(word, rng)
    elif kind == "double":
        changed = _apart(word, word)
    else:
        changed = ""
    changed = _apart(_apart(text[:start], changed), text[end:])
    return Fault(path, kind, text, changed, start, end)


def _apart(before: str, behind: str) -> str:
    """Both texts, with a blank if their neighbouring words would become one: one fault only."""
    joined = _GLUED.fullmatch(f"{before[-1:]}{behind[:1]}")
    return f"{before} {behind}" if joined else f"{before}{behind}"


def _misspelled(word: str, rng: random.Random) -> str:
    """One letter is missing, doubled, swapped with the next one or another one."""
    at = rng.randrange(1, len(word) - 1)
    return rng.choice(
        [
            word[:at] + word[at + 1 :],
            word[:at] + word[at] + word[at:],
            word[: at - 1] + word[at] + word[at - 1] + word[at + 1 :],
            word[:at] + rng.choice("aeiourstn") + word[at + 1 :],
        ]
    )


def judge(fault: Fault) -> Outcome | None:
    """What the check shows; None if the changed text is correct."""
    errors = find_errors(fault.path, fault.text)
    if not errors:
        return None
    suffix = fault.path.suffix
    line = errors[0].span.start_position[0] - 1
    first = fault.original.count("\n", 0, fault.start)
    last = fault.original.count("\n", 0, fault.end)
    fixes = [error.fix for error in errors if error.fix]
    right = [token.text for token in tokens(fault.original, suffix)]
    restored = any(
        [token.text for token in tokens(apply(fault.text, fix), suffix)] == right
        for fix in fixes[:1]
    )
    return Outcome(len(errors), first - 1 <= line <= last + 1, restored)


def apply(text: str, fix: Fix) -> str:
    """The text after the edits of a fix."""
    edits = sorted(fix.edits, key=lambda edit: (edit.span.start, edit.span.end), reverse=True)
    for edit in edits:
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text
