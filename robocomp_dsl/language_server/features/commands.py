"""The commands of code lenses, for clients that let the server execute them.

In: the arguments of `workspace/executeCommand`. Out: messages, and files that the client opens. A
client with its own view for locations may use that instead of `SHOW_REFERENCES`.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Protocol

from lsprotocol import converters
from lsprotocol import types as lsp

from robocomp_dsl.language_server.features.generation import generate
from robocomp_dsl.language_server.session import Session, UnsupportedDocument

GENERATE = "rcgen.generate"
"""Arguments: the URI of a CDSL file."""
SHOW_REFERENCES = "rcgen.showReferences"
"""Arguments: a URI, a position in it, and the locations to show."""
MAX_LOCATIONS = 20

_converter = converters.get_converter()


class Client(Protocol):
    """The part of the client that commands use."""

    @property
    def client_capabilities(self) -> lsp.ClientCapabilities:
        """The capabilities that the client announced."""

    def window_show_message(self, params: lsp.ShowMessageParams) -> None:
        """Show a message."""

    def window_show_document(self, params: lsp.ShowDocumentParams) -> object:
        """Open a file."""


async def run_generation(session: Session, client: Client, *arguments: object) -> bool:
    """Generate a component and show the result. Raises `UnsupportedDocument`."""
    if len(arguments) != 1 or not isinstance(arguments[0], str):
        raise UnsupportedDocument(f"`{GENERATE}` takes the URI of a CDSL or BDSL file")
    result = await generate(session, session.path_of(arguments[0]))
    kind = lsp.MessageType.Info if result.succeeded else lsp.MessageType.Error
    client.window_show_message(lsp.ShowMessageParams(kind, result.message))
    return result.succeeded


async def show_references(session: Session, client: Client, *arguments: object) -> None:
    """Open a single location, or list several. Raises `UnsupportedDocument`."""
    locations = _locations(arguments)
    capabilities = client.client_capabilities.window
    can_open = capabilities and capabilities.show_document and capabilities.show_document.support
    if len(locations) == 1 and can_open:
        target = locations[0]
        params = lsp.ShowDocumentParams(target.uri, take_focus=True, selection=target.range)
        client.window_show_document(params)
        return
    lines = [f"{session.path_of(each.uri)}:{each.range.start.line + 1}" for each in locations]
    more = [f"and {len(lines) - MAX_LOCATIONS} more"] if len(lines) > MAX_LOCATIONS else []
    message = "\n".join([*lines[:MAX_LOCATIONS], *more]) or "no references"
    client.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Info, message))


def _locations(arguments: tuple[object, ...]) -> list[lsp.Location]:
    try:
        _, _, data = arguments
        locations: list[lsp.Location] = _converter.structure(data, list[lsp.Location])
    except Exception:
        raise UnsupportedDocument(
            f"`{SHOW_REFERENCES}` takes a URI, a position and a list of locations"
        ) from None
    return locations


COMMANDS: Mapping[str, Callable[..., Awaitable[Any]]] = {
    GENERATE: run_generation,
    SHOW_REFERENCES: show_references,
}
