"""The server: the table of its features, and the dispatch of requests to them.

In: a connection (stdin and stdout, or TCP). Out: responses until the client disconnects. A feature
that fails returns an error response and is logged in one line; the server continues.
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
from robocomp_dsl.language_server.completion import completion
from robocomp_dsl.language_server.documents import synchronize
from robocomp_dsl.language_server.documents.diagnostics_scheduler import DiagnosticsScheduler
from robocomp_dsl.language_server.documents.file_watching import (
    FILE_OPERATIONS,
    WATCHED_GLOBS,
    registration,
)
from robocomp_dsl.language_server.errors import Feature, bind_session, guard, translate_errors
from robocomp_dsl.language_server.features import (
    call_hierarchy,
    code_lens,
    definition,
    document_links,
    document_symbols,
    folding,
    formatting,
    hover,
    inlay_hints,
    quick_fixes,
    references,
    rename,
    semantic_tokens,
    signature_help,
    type_definition,
    workspace_symbols,
)
from robocomp_dsl.language_server.features.commands import COMMANDS
from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.protocol import ServerProtocol
from robocomp_dsl.language_server.session import Document, Session

FEATURES: dict[str, tuple[Feature, Any]] = {
    lsp.TEXT_DOCUMENT_DEFINITION: (definition.definition, None),
    lsp.TEXT_DOCUMENT_TYPE_DEFINITION: (type_definition.type_definition, None),
    lsp.TEXT_DOCUMENT_HOVER: (hover.hover, None),
    lsp.TEXT_DOCUMENT_COMPLETION: (
        completion.completion,
        lsp.CompletionOptions(trigger_characters=completion.TRIGGERS),
    ),
    lsp.TEXT_DOCUMENT_SIGNATURE_HELP: (
        signature_help.signature_help,
        lsp.SignatureHelpOptions(trigger_characters=signature_help.TRIGGERS),
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
    lsp.TEXT_DOCUMENT_DOCUMENT_LINK: (document_links.document_links, None),
    lsp.TEXT_DOCUMENT_INLAY_HINT: (inlay_hints.inlay_hints, None),
    lsp.TEXT_DOCUMENT_CODE_LENS: (code_lens.code_lenses, None),
    lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY: (call_hierarchy.prepare, None),
    lsp.CALL_HIERARCHY_INCOMING_CALLS: (call_hierarchy.incoming, None),
    lsp.CALL_HIERARCHY_OUTGOING_CALLS: (call_hierarchy.outgoing, None),
}
"""Method of the protocol to its function, and the options that are announced to the client."""

GC_THRESHOLDS = (50_000, 20, 100)
"""Thresholds of the three generations of Python's garbage collector."""

_logger = logging.getLogger(__name__)


class Server(LanguageServer):
    """The server of one client."""

    def __init__(self) -> None:
        super().__init__("rcgen", __version__, protocol_cls=ServerProtocol)
        self.session = Session()
        self.scheduler = DiagnosticsScheduler(self.session, self.text_document_publish_diagnostics)
        for method, handler in self._notifications().items():
            self.feature(method)(guard(method, handler))
        for method in FILE_OPERATIONS:
            self.feature(method, WATCHED_GLOBS)(guard(method, self._disk_changed))
        for method, (function, options) in FEATURES.items():
            handler = bind_session(function, self.session)
            self.feature(method, options)(guard(method, handler))
        for name, command in COMMANDS.items():
            self.command(name)(self._command(name, command))

    @property
    def exit_code(self) -> int:
        """0 if the client sent `shutdown` before `exit`, else 1."""
        return (
            0
            if isinstance(self.protocol, ServerProtocol) and self.protocol.shutdown_requested
            else 1
        )

    def _command(self, name: str, command: Callable[..., Awaitable[Any]]) -> Callable[..., Any]:
        async def run(*arguments: Any) -> Any:
            with translate_errors(name):
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
        encoding = ServerCapabilitiesBuilder.choose_position_encoding(params.capabilities)
        self.session.positions = PositionCodec(encoding)
        uris = [folder.uri for folder in params.workspace_folders or ()]
        uris = uris or [params.root_uri or ""]
        self.session.folders = _folders(uris)

    def _initialized(self, _: object) -> None:
        """Register for changes of files outside the editor."""
        registration_params = registration(self.client_capabilities)
        if registration_params:
            self.client_register_capability(registration_params)

    def _opened(self, params: lsp.DidOpenTextDocumentParams) -> None:
        document = synchronize.did_open(self.session, params)
        if document:
            self.scheduler.document_changed(document)

    def _changed(self, params: lsp.DidChangeTextDocumentParams) -> None:
        self.scheduler.document_changed(synchronize.did_change(self.session, params))

    def _closed(self, params: lsp.DidCloseTextDocumentParams) -> None:
        document: Document | None = synchronize.did_close(self.session, params)
        if document:
            self.scheduler.document_closed(document)

    def _disk_changed(self, _: object) -> None:
        self.scheduler.recheck_all()

    def _folders_changed(self, params: lsp.DidChangeWorkspaceFoldersParams) -> None:
        removed = _folders([folder.uri for folder in params.event.removed])
        added = _folders([folder.uri for folder in params.event.added])
        remaining = [folder for folder in self.session.folders if folder not in removed]
        self.session.folders = [*remaining, *added]


def serve_stdio() -> int:
    """Serve on stdin and stdout until the client disconnects; returns the exit code."""
    _prepare_process()
    # pygls closes its output stream; the process still flushes its own stdout when it exits.
    with os.fdopen(os.dup(sys.stdout.fileno()), "wb") as stdout:
        server = Server()
        server.start_io(stdout=stdout)
    return server.exit_code


def serve_tcp(host: str, port: int) -> int:
    """Serve one client at `host`:`port` until it disconnects; returns the exit code.

    Raises `OSError`.
    """
    _prepare_process()
    # Logs the port, which the system chooses for port 0.
    logging.getLogger("pygls.server").setLevel(logging.INFO)
    server = Server()
    with suppress(SystemExit):
        server.start_tcp(host, port)
    return server.exit_code


def _folders(uris: list[str]) -> list[Path]:
    paths = (to_fs_path(uri) for uri in uris if uri)
    return [Path(path) for path in paths if path]


def _prepare_process() -> None:
    """Log warnings to stderr (stdout carries the protocol), and run the garbage collector rarely.

    Trees have no cycles, and a full collection takes longer than a check.
    """
    gc.set_threshold(*GC_THRESHOLDS)
    logging.basicConfig(stream=sys.stderr, level=logging.WARNING, format="rcgen lsp: %(message)s")
    # pygls logs the traceback of every error response.
    logging.getLogger("pygls").setLevel(logging.CRITICAL)
