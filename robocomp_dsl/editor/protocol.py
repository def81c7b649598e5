"""The protocol as pygls has it, held to the specification at its edges.

In: messages of a client. Out: handlers called, and an error for each request that cannot be
understood, comes before `initialize` or after `shutdown` (Language Server Protocol 3.17, Server
lifecycle). Texts are kept by the session alone, with its own idea of lines.
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


class Protocol(LanguageServerProtocol):
    """`begun`: the client has sent `initialize`."""

    begun = False

    @property
    def ended(self) -> bool:
        """Whether the client has asked to shut down."""
        return bool(self._shutdown)

    @lsp_method(lsp.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: lsp.DidOpenTextDocumentParams) -> Iterator[Any]:
        """Hand on to the session."""
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_OPEN], (params,), None

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(
        self, params: lsp.DidChangeTextDocumentParams
    ) -> Iterator[Any]:
        """Hand on to the session."""
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_CHANGE], (params,), None

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: lsp.DidCloseTextDocumentParams) -> Iterator[Any]:
        """Hand on to the session."""
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_CLOSE], (params,), None

    def structure_message(self, data: dict[str, Any]) -> Any:
        """The message that `data` is; None for one that cannot be read.

        pygls drops those, and a client would wait for its answer for ever.
        """
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            if "id" in data and "method" in data:
                refusal = JsonRpcInvalidParams(f"{data['method']}: {_reason(error)}")
                self._send_response(data["id"], None, refusal.to_response_error())
            return None

    def handle_message(self, message: Any) -> None:
        """Call the handler of `message`, if its time has come."""
        method = getattr(message, "method", None)
        if not hasattr(message, "jsonrpc"):
            return
        refusal = self._refusal(method) if method else None
        if refusal is None:
            self.begun |= method == lsp.INITIALIZE
            super().handle_message(message)
        elif hasattr(message, "id"):
            self._send_response(message.id, None, refusal.to_response_error())

    def _refusal(self, method: str) -> JsonRpcException | None:
        if method == lsp.EXIT:
            return None
        if self.ended:
            return JsonRpcInvalidRequest("the server has been shut down")
        if not self.begun and method != lsp.INITIALIZE:
            return JsonRpcServerNotInitialized("the first request must be `initialize`")
        if self.begun and method == lsp.INITIALIZE:
            return JsonRpcInvalidRequest("`initialize` was sent already")
        return None


def _reason(error: BaseException) -> str:
    """The innermost words on why a message cannot be read."""
    cause = error.__cause__
    while cause is not None:
        error, inner = cause, getattr(cause, "exceptions", ())
        cause = inner[0] if inner else None
    return str(error) or type(error).__name__
