"""The protocol layer: pygls with the lifecycle rules of the specification.

In: messages of a client. Out: calls of handlers, and an error for each request that is malformed or
that arrives before `initialize` or after `shutdown` (Language Server Protocol 3.17, Server
lifecycle). Only the session stores documents; pygls' own document store stays empty.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import (
    JsonRpcException,
    JsonRpcInvalidParams,
    JsonRpcInvalidRequest,
    JsonRpcServerNotInitialized,
)
from pygls.protocol import LanguageServerProtocol, lsp_method


class ServerProtocol(LanguageServerProtocol):
    """`initialized`: the client has sent `initialize`."""

    initialized = False

    @property
    def shutdown_requested(self) -> bool:
        """Whether the client has asked to shut down."""
        return bool(self._shutdown)

    @lsp_method(lsp.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: lsp.DidOpenTextDocumentParams) -> Iterator[Any]:
        """Call the session's handler only."""
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_OPEN], (params,), None

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(
        self, params: lsp.DidChangeTextDocumentParams
    ) -> Iterator[Any]:
        """Call the session's handler only."""
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_CHANGE], (params,), None

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: lsp.DidCloseTextDocumentParams) -> Iterator[Any]:
        """Call the session's handler only."""
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_CLOSE], (params,), None

    def structure_message(self, data: dict[str, Any]) -> Any:
        """Parse `data` into a message; None if it is malformed.

        A malformed request gets an error response; pygls would drop it, and the client would wait.
        """
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            if "id" in data and "method" in data:
                invalid = JsonRpcInvalidParams(f"{data['method']}: {_reason(error)}")
                self._send_response(data["id"], None, invalid.to_response_error())
            return None

    def handle_message(self, message: Any) -> None:
        """Call the handler of `message` if the lifecycle allows it."""
        method = getattr(message, "method", None)
        if not hasattr(message, "jsonrpc"):
            return
        error = self._lifecycle_error(method) if method else None
        if error is None:
            self.initialized |= method == lsp.INITIALIZE
            super().handle_message(message)
        elif hasattr(message, "id"):
            self._send_response(message.id, None, error.to_response_error())

    def _lifecycle_error(self, method: str) -> JsonRpcException | None:
        if method == lsp.EXIT:
            return None
        if self.shutdown_requested:
            return JsonRpcInvalidRequest("the server has been shut down")
        if not self.initialized and method != lsp.INITIALIZE:
            return JsonRpcServerNotInitialized("the first request must be `initialize`")
        if self.initialized and method == lsp.INITIALIZE:
            return JsonRpcInvalidRequest("`initialize` was sent already")
        return None


def _reason(error: BaseException) -> str:
    """The innermost reason why a message is malformed."""
    cause = error.__cause__
    while cause is not None:
        error, inner = cause, getattr(cause, "exceptions", ())
        cause = inner[0] if inner else None
    return str(error) or type(error).__name__
