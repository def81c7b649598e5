"""IDSL files with everything they import, resolved once and kept until one of the texts changes.

In: a path. Out: `Loaded`, whose `modules` are shared by every file that imports them, so that one
declaration is one object.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check import codes
from robocomp_dsl.check.files import Files, Parsed, identity
from robocomp_dsl.check.imports import find_import, locate, report_cycle, report_repeated
from robocomp_dsl.check.loaded import Link, Loaded
from robocomp_dsl.check.resolve_idsl import resolve_idsl
from robocomp_dsl.check.rules_idsl import judge_idsl
from robocomp_dsl.check.search import Search
from robocomp_dsl.check.suggest import Offer, offer_import
from robocomp_dsl.check.visible import Tree, Visible
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.interface import Module
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax import parse_idsl
from robocomp_dsl.syntax.ast_base import Import, QualifiedName

MAX_DEPTH = 50
"""Imports within imports; more is a mistake, and would exhaust the stack."""


class Library:
    """All IDSL files of a workspace."""

    def __init__(self, files: Files, search: Search) -> None:
        self._files = files
        self._search = search
        self._kept: dict[str, Loaded] = {}
        self._fresh: set[str] = set()
        self._open: list[tuple[str, Import | None]] = []
        self._in_cycle: set[str] = set()
        self._root = Path()

    def begin(self, root: Path) -> None:
        """Start to check the file `root`: imports are looked for from there, files looked at again.

        All files behind one root see the same file for the same name, wherever they are.
        """
        self._root = root
        self._search.begin()
        self._fresh.clear()
        for key in self._in_cycle:
            self._kept.pop(key, None)
        self._in_cycle.clear()

    def load(self, path: Path, statement: Import | None = None) -> Loaded:
        """The file at `path`, which `statement` asked for. Raises `UnreadableSource`."""
        key = identity(path)
        kept = self._kept.get(key)
        if kept is not None and self._is_fresh(key, kept, path):
            return kept
        self._open.append((key, statement))
        try:
            made = self._resolve(path)
        finally:
            self._open.pop()
        self._kept[key] = made
        self._fresh.add(key)
        return made

    def links(self, statements: tuple[Import, ...], report: Report) -> list[Link]:
        """What import statements lead to; what leads nowhere is reported."""
        report_repeated(statements, report)
        return [self._link(one, report) for one in statements]

    def _link(self, statement: Import, report: Report) -> Link:
        path = find_import(statement, self._root, self._search, report)
        if path is None or self._closes_cycle(path, statement, report):
            return Link(statement, path, None)
        try:
            return Link(statement, path, self.load(path, statement))
        except UnreadableSource as error:
            span = statement.path.span
            report.add(codes.UNREADABLE_IMPORT, span, f"cannot read `{path}`: {error}")
            return Link(statement, path, None)

    def _closes_cycle(self, path: Path, statement: Import, report: Report) -> bool:
        """Whether `path` is being read already; it is then reported and not entered again."""
        keys = [key for key, _ in self._open]
        key = identity(path)
        if key not in keys:
            if len(keys) >= MAX_DEPTH:
                report.add(
                    codes.IMPORTS_TOO_DEEP,
                    statement.path.span,
                    f"imports nest deeper than {MAX_DEPTH} files",
                )
            return len(keys) >= MAX_DEPTH
        members = self._open[keys.index(key) :]
        into = [via for _, via in members[1:] if via is not None]
        self._in_cycle.update(one for one, _ in members)
        report_cycle(
            [(one, via) for (one, _), via in zip(members, (*into, statement), strict=True)], report
        )
        return True

    def _resolve(self, path: Path) -> Loaded:
        parsed = self._files.parse(path, parse_idsl)
        report = Report()
        report.extend(parsed.findings)
        links = tuple(self.links(parsed.tree.imports, report))
        modules: list[Module] = []
        for tree in parsed.tree.modules:
            visible = self.visible(parsed, links, modules)
            resolved = resolve_idsl(tree, path, visible, report)
            judge_idsl(resolved, report)
            modules.append(resolved.module)
        return Loaded(parsed, links, tuple(modules), tuple(report))

    def visible(
        self, file: Parsed[Tree], links: Sequence[Link], earlier: Sequence[Module] = ()
    ) -> Visible:
        """What names can mean in `file`."""
        statements = [link.statement for link in links]

        def offer(name: QualifiedName) -> Offer | None:
            return offer_import(name, file.source, statements, self._files, self._search)

        return Visible(file, links, offer, earlier)

    def _is_fresh(self, key: str, kept: Loaded, path: Path) -> bool:
        """Whether nothing changed in the file, in the way its imports lead, or behind them."""
        if key in self._fresh:
            return True
        if self._files.read(path) is not kept.parsed.source:
            return False
        if not all(self._still_leads(link) for link in kept.links):
            return False
        self._fresh.add(key)
        return True

    def _still_leads(self, link: Link) -> bool:
        found = locate(link.statement, self._root, self._search)
        if found is None or link.loaded is None:
            return False  # what the finding says depends on where was searched
        key = identity(found)
        same = found == link.path and self._kept.get(key) is link.loaded
        return same and self._is_fresh(key, link.loaded, found)
