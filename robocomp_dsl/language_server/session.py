"""The session: the open documents of one client, their findings and models.

In: the texts of documents. Out: `CheckResult` values, recomputed only when the file or one of its
dependencies has changed.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from pygls.uris import from_fs_path, to_fs_path

from robocomp_dsl.check.languages import CHECKS, PARSERS, check_file
from robocomp_dsl.check.workspace.discovery import find_descriptions
from robocomp_dsl.check.workspace.source_cache import Parsed, canonical_path
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.language_server.documents.dependency_tracker import DependencyTracker
from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.symbols.index import build_index
from robocomp_dsl.language_server.symbols.symbol import Index, Occurrence
from robocomp_dsl.source import Source, UnreadableSource

if TYPE_CHECKING:
    from robocomp_dsl.check.languages import Model

BACKGROUND_CHECK_CHARS = 300_000
"""A file of this size (about ten thousand lines, half a second) is checked in the background."""
MAX_FILES = 5000
"""The server reads at most this many files of the workspace folders."""


class UnsupportedDocument(Exception):
    """The document is not open, not readable, or in a language that the server does not support."""


class CheckPending(UnreadableSource):
    """The background check of a large file has not finished."""


@dataclass(frozen=True, slots=True, eq=False)
class CheckResult:
    """The result of a check; `dependencies` are the canonical paths of the files it accessed."""

    source: Source
    findings: tuple[Diagnostic, ...]
    model: Model | None
    dependencies: frozenset[str]
    tree: object

    @property
    def complete(self) -> bool:
        """Whether the text had no syntax errors."""
        return bool(getattr(self.tree, "complete", False))


@dataclass(slots=True)
class Document:
    """A document that the client has open. `last_valid` is its last check without syntax errors.

    `outdated`: a dependency has changed since the check. `check_pending`: a background check is
    running; it also provides the `index`.
    """

    uri: str
    path: Path
    version: int | None
    checked: CheckResult | None = None
    last_valid: CheckResult | None = None
    outdated: bool = False
    check_pending: bool = False
    index: Index | None = None


@dataclass(slots=True)
class Session:
    """The open documents by canonical path, the files read, and the agreed position encoding."""

    folders: list[Path] = field(default_factory=list)
    environ: Mapping[str, str] = field(default_factory=lambda: os.environ)
    documents: dict[str, Document] = field(default_factory=dict)
    files: DependencyTracker = field(default_factory=DependencyTracker)
    positions: PositionCodec = field(default_factory=PositionCodec)
    workspace: Workspace = field(init=False)

    def __post_init__(self) -> None:
        self.workspace = Workspace((), self.environ, files=self.files)

    def path_of(self, uri: str) -> Path:
        """The file that `uri` names. Raises `UnsupportedDocument`."""
        path = to_fs_path(uri) if urlsplit(uri).scheme == "file" else None
        if not path or Path(path).suffix.lower() not in CHECKS:
            raise UnsupportedDocument(f"`{uri}` is not a file of a supported language")
        return Path(path)

    def uri_of(self, path: Path) -> str:
        """The URI that the client uses for `path`."""
        document = self.documents.get(canonical_path(path))
        return document.uri if document else from_fs_path(os.path.abspath(path)) or ""  # noqa: PTH100 - symbolic links stay

    def open(self, uri: str, text: str, version: int | None) -> Document:
        """Open a document: `text` overrides the file on the disk."""
        path = self.path_of(uri)
        document = Document(uri, path, version)
        self.documents[canonical_path(path)] = document
        self.files.set_overlay(path, text)
        return document

    def close(self, document: Document) -> None:
        """Close a document: the file on the disk counts again."""
        self.documents.pop(canonical_path(document.path), None)
        self.files.remove_overlay(document.path)

    def document(self, uri: str) -> Document:
        """The open document with that URI. Raises `UnsupportedDocument`."""
        document = self.documents.get(canonical_path(self.path_of(uri)))
        if document is None:
            raise UnsupportedDocument(f"`{uri}` is not open")
        return document

    def source(self, uri: str) -> Source:
        """The text of a file, open or not. Raises `UnsupportedDocument` and `CheckPending`."""
        path = self.path_of(uri)
        self._raise_if_pending(path)
        try:
            return self.files.read(path)
        except UnreadableSource as error:
            raise UnsupportedDocument(f"cannot read `{uri}`: {error}") from None

    def check(self, path: Path) -> CheckResult:
        """Check a file and store the result. Raises `UnreadableSource`."""
        report = Report()
        with self.files.track() as dependencies:
            source = self.files.read(path)
            model = check_file(path, self.workspace, report)
            tree = self.parsed(path).tree
        result = CheckResult(source, tuple(report), model, frozenset(dependencies), tree)
        document = self.documents.get(canonical_path(path))
        if document:
            document.checked = result
            document.outdated = False
            document.last_valid = result if result.complete else document.last_valid
        return result

    def checked(self, path: Path) -> CheckResult:
        """The last check result of an open file; any other file is checked now.

        Raises `UnreadableSource`.
        """
        self._raise_if_pending(path)
        document = self.documents.get(canonical_path(path))
        cached = document.checked if document and not document.outdated else None
        if cached and cached.source is self.files.read(path):
            return cached
        return self.check(path)

    def checks_for_completion(self, path: Path) -> list[CheckResult]:
        """The current check result, and the last one without syntax errors if that is another.

        A document is usually incomplete while the user types. Raises `UnreadableSource`.
        """
        current = self.checked(path)
        document = self.documents.get(canonical_path(path))
        last_valid = document.last_valid if document else None
        return [current, last_valid] if last_valid and last_valid is not current else [current]

    def parsed(self, path: Path) -> Parsed[object]:
        """The tree of a file. Raises `UnreadableSource`."""
        return self.files.parse(path, PARSERS[path.suffix.lower()])

    def index(self, path: Path) -> Index:
        """The index of a file. Raises `UnreadableSource`."""
        self._raise_if_pending(path)
        document = self.documents.get(canonical_path(path))
        cached = document.index if document and not document.outdated else None
        if cached and cached.source is self.files.read(path):
            return cached
        return build_index(path, self.workspace)

    def snapshot(self) -> Session:
        """An independent session with the same texts, for another thread."""
        result = Session(list(self.folders), self.environ, positions=self.positions)
        for document in self.documents.values():
            text = self.files.read(document.path).text
            result.open(document.uri, text, document.version)
        return result

    def merge(self, document: Document, snapshot: Session) -> None:
        """Copy the results of `snapshot` for a document with the same text in both."""
        checked = snapshot.documents[canonical_path(document.path)]
        self.files.copy_buffer(document.path, snapshot.files)
        document.checked, document.index = checked.checked, checked.index
        document.last_valid = checked.last_valid or document.last_valid
        document.outdated = document.check_pending = False

    def _raise_if_pending(self, path: Path) -> None:
        document = self.documents.get(canonical_path(path))
        if document and document.check_pending:
            raise CheckPending(f"`{path.name}` is still being checked")

    def occurrences_in(self, path: Path) -> tuple[Occurrence, ...]:
        """The occurrences in a file; none if it is unreadable."""
        try:
            return self.index(path).occurrences
        except UnreadableSource:
            return ()

    def known_files(self) -> Iterable[Path]:
        """The open files and the description files in the workspace folders, each once."""
        paths = {key: document.path for key, document in self.documents.items()}
        for folder in self.folders:
            for path in find_descriptions(folder):
                if len(paths) >= MAX_FILES:
                    break
                paths.setdefault(canonical_path(path), path)
        return paths.values()
