"""What reading an IDSL file gives: its tree, its imports, its modules, and what was wrong."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from robocomp_dsl.check.files import Parsed
from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.model.interface import Module
from robocomp_dsl.record import Record
from robocomp_dsl.syntax import ast_idsl
from robocomp_dsl.syntax.ast_base import Import


class Link(Record):
    """One import statement and the file it leads to, if it leads to one."""

    statement: Import
    path: Path | None
    loaded: Loaded | None


class Loaded(Record):
    """One IDSL file. `findings` are about this file alone, form and meaning."""

    parsed: Parsed[ast_idsl.File]
    links: tuple[Link, ...]
    modules: tuple[Module, ...]
    findings: tuple[Diagnostic, ...]


def every_file(links: Iterable[Link]) -> Iterator[Loaded]:
    """The files behind `links`, directly or not, each once."""
    seen: dict[int, Loaded] = {}
    todo = [one.loaded for one in links if one.loaded]
    while todo:
        one = todo.pop(0)
        if id(one) not in seen:
            seen[id(one)] = one
            todo.extend(link.loaded for link in one.links if link.loaded)
    return iter(seen.values())


def errors_behind(links: Iterable[Link]) -> Iterator[Diagnostic]:
    """What is wrong in the imported files, directly or not."""
    for file in every_file(links):
        yield from (d for d in file.findings if d.severity is Severity.ERROR)
