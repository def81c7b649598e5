"""What the server knows of one client's work: open files, their findings, their models.

In: texts as they are opened and changed. Out: `Checked` values, made again only when the file or
one that it depends on changed.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from pygls.uris import from_fs_path, to_fs_path

from robocomp_dsl.check import CHECKS, PARSERS, check_file
from robocomp_dsl.check.described import described
from robocomp_dsl.check.files import Parsed, identity
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.editor.index import Index, Mention, make_index
from robocomp_dsl.editor.recording import RecordingFiles
from robocomp_dsl.source import Source, UnreadableSource

if TYPE_CHECKING:
    from robocomp_dsl.check import Model

HUGE = 300_000
"""Characters from which on a file is checked aside: some ten thousand lines, half a second."""
MOST_FILES = 5000
"""Files of the workspace folders that are looked at; more is not a robot's software any more."""


class NoDescription(Exception):
    """The client asked about a file that this server cannot know anything of."""


class StillChecking(UnreadableSource):
    """A huge file is being checked; until then nothing is said about it."""


@dataclass(frozen=True, slots=True, eq=False)
class Checked:
    """What a check of one file gave; `asked` are the identities of the files it looked at."""

    source: Source
    findings: tuple[Diagnostic, ...]
    model: Model | None
    asked: frozenset[str]
    tree: object

    @property
    def complete(self) -> bool:
        """Whether the text had no form errors."""
        return bool(getattr(self.tree, "complete", False))


@dataclass(slots=True)
class Document:
    """A file that the client has open. `good` is the last check of it without form errors.

    `stale`: a file that the check looked at has changed since. `pending`: it is huge and its check
    has not come back; then its `index` comes along.
    """

    uri: str
    path: Path
    version: int | None
    checked: Checked | None = None
    good: Checked | None = None
    stale: bool = False
    pending: bool = False
    index: Index | None = None


@dataclass(slots=True)
class Session:
    """The open documents by the identity of their file, and everything known of the others."""

    folders: list[Path] = field(default_factory=list)
    environ: Mapping[str, str] = field(default_factory=lambda: os.environ)
    documents: dict[str, Document] = field(default_factory=dict)
    files: RecordingFiles = field(default_factory=RecordingFiles)
    workspace: Workspace = field(init=False)

    def __post_init__(self) -> None:
        self.workspace = Workspace((), self.environ, files=self.files)

    def path_of(self, uri: str) -> Path:
        """The file that `uri` names. Raises `NoDescription`."""
        found = to_fs_path(uri) if urlsplit(uri).scheme == "file" else None
        if not found or Path(found).suffix.lower() not in CHECKS:
            raise NoDescription(f"`{uri}` is not a file of a language that this server knows")
        return Path(found)

    def uri_of(self, path: Path) -> str:
        """The name that the client has for `path`."""
        document = self.documents.get(identity(path))
        return document.uri if document else from_fs_path(os.path.abspath(path)) or ""  # noqa: PTH100 - symbolic links stay

    def open(self, uri: str, text: str, version: int | None) -> Document:
        """Take `text` for what is in the file from now on."""
        path = self.path_of(uri)
        document = Document(uri, path, version)
        self.documents[identity(path)] = document
        self.files.open_buffer(path, text)
        return document

    def close(self, document: Document) -> None:
        """Believe the disk again."""
        self.documents.pop(identity(document.path), None)
        self.files.close_buffer(document.path)

    def document(self, uri: str) -> Document:
        """The open document called `uri`. Raises `NoDescription`."""
        found = self.documents.get(identity(self.path_of(uri)))
        if found is None:
            raise NoDescription(f"`{uri}` is not open")
        return found

    def source(self, uri: str) -> Source:
        """The text of a file, open or not. Raises `NoDescription` and `StillChecking`."""
        path = self.path_of(uri)
        self._refuse_pending(path)
        try:
            return self.files.read(path)
        except UnreadableSource as error:
            raise NoDescription(f"cannot read `{uri}`: {error}") from None

    def check(self, path: Path) -> Checked:
        """Check a file now. Raises `UnreadableSource`."""
        report = Report()
        with self.files.recording() as asked:
            source = self.files.read(path)
            model = check_file(path, self.workspace, report)
            tree = self.parsed(path).tree
        made = Checked(source, tuple(report), model, frozenset(asked), tree)
        document = self.documents.get(identity(path))
        if document:
            document.checked = made
            document.stale = False
            document.good = made if made.complete else document.good
        return made

    def checked(self, path: Path) -> Checked:
        """The last check of an open file; one that is not open is checked again.

        Raises `UnreadableSource`.
        """
        self._refuse_pending(path)
        document = self.documents.get(identity(path))
        kept = document.checked if document and not document.stale else None
        if kept and kept.source is self.files.read(path):
            return kept
        return self.check(path)

    def checks_to_complete(self, path: Path) -> list[Checked]:
        """What a half-typed text may refer to: what it says now, and what it said when whole.

        Raises `UnreadableSource`.
        """
        now = self.checked(path)
        document = self.documents.get(identity(path))
        good = document.good if document else None
        return [now, good] if good and good is not now else [now]

    def parsed(self, path: Path) -> Parsed[object]:
        """The tree of a file. Raises `UnreadableSource`."""
        return self.files.parse(path, PARSERS[path.suffix.lower()])

    def index(self, path: Path) -> Index:
        """What the names in a file mean. Raises `UnreadableSource`."""
        self._refuse_pending(path)
        document = self.documents.get(identity(path))
        kept = document.index if document and not document.stale else None
        if kept and kept.source is self.files.read(path):
            return kept
        return make_index(path, self.workspace)

    def twin(self) -> Session:
        """A session with the same texts and nothing else in common, for another thread."""
        made = Session(list(self.folders), self.environ)
        for document in self.documents.values():
            text = self.files.read(document.path).text
            made.open(document.uri, text, document.version)
        return made

    def adopt(self, document: Document, twin: Session) -> None:
        """Take over what `twin` found out about a document, whose text is the same in both."""
        theirs = twin.documents[identity(document.path)]
        self.files.adopt(document.path, twin.files)
        document.checked, document.index = theirs.checked, theirs.index
        document.good = theirs.good or document.good
        document.stale = document.pending = False

    def _refuse_pending(self, path: Path) -> None:
        document = self.documents.get(identity(path))
        if document and document.pending:
            raise StillChecking(f"`{path.name}` is still being checked")

    def index_or_nothing(self, path: Path) -> tuple[Mention, ...]:
        """The names in a file, or none where it cannot be read: one broken file hides no others."""
        try:
            return self.index(path).mentions
        except UnreadableSource:
            return ()

    def every_file(self) -> Iterable[Path]:
        """The open files and the descriptions in the workspace folders, each once."""
        found = {key: document.path for key, document in self.documents.items()}
        for folder in self.folders:
            for path in described(folder):
                if len(found) >= MOST_FILES:
                    break
                found.setdefault(identity(path), path)
        return found.values()
