"""The server: the table of its features, and how questions reach them.

In: a connection (stdin and stdout, or TCP). Out: answers until the client leaves. A feature that
fails answers an error, which is logged in one line, and the server lives on.
"""

from __future__ import annotations

import gc
import logging
import os
import sys
from collections.abc import Awaitable, Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls.capabilities import ServerCapabilitiesBuilder
from pygls.lsp.server import LanguageServer
from pygls.uris import to_fs_path

from robocomp_dsl import __version__
from robocomp_dsl.editor import (
    call_hierarchy,
    code_lens,
    completion,
    definition,
    document_symbols,
    folding,
    formatting,
    hover,
    inlay_hints,
    links,
    quick_fixes,
    references,
    rename,
    semantic_tokens,
    synchronize,
    type_definition,
    workspace_symbols,
)
from robocomp_dsl.editor.answers import Feature, answering, explained, guarded
from robocomp_dsl.editor.checking import Checking
from robocomp_dsl.editor.commands import COMMANDS
from robocomp_dsl.editor.positions import agree
from robocomp_dsl.editor.protocol import Protocol
from robocomp_dsl.editor.session import Document, Session
from robocomp_dsl.editor.watching import MOVED, OURS, registration

FEATURES: dict[str, tuple[Feature, Any]] = {
    lsp.TEXT_DOCUMENT_DEFINITION: (definition.definition, None),
    lsp.TEXT_DOCUMENT_TYPE_DEFINITION: (type_definition.type_definition, None),
    lsp.TEXT_DOCUMENT_HOVER: (hover.hover, None),
    lsp.TEXT_DOCUMENT_COMPLETION: (
        completion.completion,
        lsp.CompletionOptions(trigger_characters=completion.TRIGGERS),
    ),
    lsp.TEXT_DOCUMENT_REFERENCES: (references.references, None),
    lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: (references.highlights, None),
    lsp.TEXT_DOCUMENT_RENAME: (rename.rename, lsp.RenameOptions(prepare_provider=True)),
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: (rename.prepare, None),
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: (document_symbols.document_symbols, None),
    lsp.WORKSPACE_SYMBOL: (workspace_symbols.workspace_symbols, None),
    lsp.TEXT_DOCUMENT_CODE_ACTION: (
        quick_fixes.code_actions,
        lsp.CodeActionOptions(code_action_kinds=quick_fixes.KINDS),
    ),
    lsp.TEXT_DOCUMENT_FORMATTING: (formatting.formatting, None),
    lsp.TEXT_DOCUMENT_RANGE_FORMATTING: (formatting.range_formatting, None),
    lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL: (
        semantic_tokens.semantic_tokens,
        semantic_tokens.LEGEND,
    ),
    lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE: (
        semantic_tokens.tokens_in_range,
        semantic_tokens.LEGEND,
    ),
    lsp.TEXT_DOCUMENT_FOLDING_RANGE: (folding.folding_ranges, None),
    lsp.TEXT_DOCUMENT_DOCUMENT_LINK: (links.document_links, None),
    lsp.TEXT_DOCUMENT_INLAY_HINT: (inlay_hints.inlay_hints, None),
    lsp.TEXT_DOCUMENT_CODE_LENS: (code_lens.code_lenses, None),
    lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY: (call_hierarchy.prepare, None),
    lsp.CALL_HIERARCHY_INCOMING_CALLS: (call_hierarchy.incoming, None),
    lsp.CALL_HIERARCHY_OUTGOING_CALLS: (call_hierarchy.outgoing, None),
}
"""Method of the protocol to the function that answers it, and what the client is told of it."""

COLLECTION = (50_000, 20, 100)
"""Thresholds of the three generations of Python's garbage collector."""

_logger = logging.getLogger(__name__)


class Server(LanguageServer):
    """One client's server."""

    def __init__(self) -> None:
        super().__init__("rcgen", __version__, protocol_cls=Protocol)
        self.session = Session()
        self.checking = Checking(self.session, self.text_document_publish_diagnostics)
        for method, handler in self._notifications().items():
            self.feature(method)(guarded(method, handler))
        for method in MOVED:
            self.feature(method, OURS)(guarded(method, self._disk_changed))
        for method, (function, options) in FEATURES.items():
            handler = answering(function, self.session)
            self.feature(method, options)(guarded(method, handler))
        for name, command in COMMANDS.items():
            self.command(name)(self._command(name, command))

    @property
    def exit_code(self) -> int:
        """0 if the client asked to shut down before it left, else 1."""
        return 0 if isinstance(self.protocol, Protocol) and self.protocol.ended else 1

    def _command(self, name: str, command: Callable[..., Awaitable[Any]]) -> Callable[..., Any]:
        async def run(*arguments: Any) -> Any:
            with explained(name):
                return await command(self.session, self, *arguments)

        return run

    def _notifications(self) -> dict[str, Callable[[Any], Any]]:
        return {
            lsp.INITIALIZE: self._initialize,
            lsp.INITIALIZED: self._initialized,
            lsp.TEXT_DOCUMENT_DID_OPEN: self._opened,
            lsp.TEXT_DOCUMENT_DID_CHANGE: self._changed,
            lsp.TEXT_DOCUMENT_DID_CLOSE: self._closed,
            lsp.TEXT_DOCUMENT_DID_SAVE: self._disk_changed,
            lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES: self._disk_changed,
            lsp.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS: self._folders_changed,
        }

    def _initialize(self, params: lsp.InitializeParams) -> None:
        agree(ServerCapabilitiesBuilder.choose_position_encoding(params.capabilities))
        uris = [folder.uri for folder in params.workspace_folders or ()]
        uris = uris or [params.root_uri or ""]
        self.session.folders = _folders(uris)

    def _initialized(self, _: object) -> None:
        """Ask to be told of files that change outside of the editor."""
        asked = registration(self.client_capabilities)
        if asked:
            self.client_register_capability(asked)

    def _opened(self, params: lsp.DidOpenTextDocumentParams) -> None:
        document = synchronize.did_open(self.session, params)
        if document:
            self.checking.changed(document)

    def _changed(self, params: lsp.DidChangeTextDocumentParams) -> None:
        self.checking.changed(synchronize.did_change(self.session, params))

    def _closed(self, params: lsp.DidCloseTextDocumentParams) -> None:
        document: Document | None = synchronize.did_close(self.session, params)
        if document:
            self.checking.closed(document)

    def _disk_changed(self, _: object) -> None:
        self.checking.everything()

    def _folders_changed(self, params: lsp.DidChangeWorkspaceFoldersParams) -> None:
        gone = _folders([folder.uri for folder in params.event.removed])
        come = _folders([folder.uri for folder in params.event.added])
        kept = [one for one in self.session.folders if one not in gone]
        self.session.folders = [*kept, *come]


def serve_stdio() -> int:
    """Answer on stdin and stdout until the client leaves. The exit code of the specification."""
    _prepare_process()
    # pygls closes what it writes to; the process still flushes its own stdout when it ends.
    with os.fdopen(os.dup(sys.stdout.fileno()), "wb") as stdout:
        server = Server()
        server.start_io(stdout=stdout)
    return server.exit_code


def serve_tcp(host: str, port: int) -> int:
    """Wait for one client at `host`:`port` and answer it until it leaves. Raises `OSError`."""
    _prepare_process()
    # Tells on which port, which is news where it was left to the system (0).
    logging.getLogger("pygls.server").setLevel(logging.INFO)
    server = Server()
    with suppress(SystemExit):
        server.start_tcp(host, port)
    return server.exit_code


def _folders(uris: list[str]) -> list[Path]:
    paths = (to_fs_path(uri) for uri in uris if uri)
    return [Path(path) for path in paths if path]


def _prepare_process() -> None:
    """Log warnings and worse to stderr, as stdout belongs to the protocol; collect rarely.

    Trees have no cycles, and a full collection over all that is kept takes longer than a check.
    """
    gc.set_threshold(*COLLECTION)
    logging.basicConfig(stream=sys.stderr, level=logging.WARNING, format="rcgen lsp: %(message)s")
    # pygls logs whole traces of what it answers as an error anyway.
    logging.getLogger("pygls").setLevel(logging.CRITICAL)
