"""Commands that a code lens names, for clients that let the server execute them.

In: the arguments of `workspace/executeCommand`. Out: messages, and files that the client opens. A
client that has a list of places of its own may show it instead of `SHOW_REFERENCES`.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Protocol

from lsprotocol import converters
from lsprotocol import types as lsp

from robocomp_dsl.editor.generation import generate
from robocomp_dsl.editor.session import NoDescription, Session

GENERATE = "rcgen.generate"
"""Arguments: the URI of a CDSL file."""
SHOW_REFERENCES = "rcgen.showReferences"
"""Arguments: a URI, a position in it, and the locations to show."""
MOST_PLACES = 20

_converter = converters.get_converter()


class Client(Protocol):
    """What is asked of the client."""

    @property
    def client_capabilities(self) -> lsp.ClientCapabilities:
        """What it can do."""

    def window_show_message(self, params: lsp.ShowMessageParams) -> None:
        """Show a message."""

    def window_show_document(self, params: lsp.ShowDocumentParams) -> object:
        """Open a file."""


async def run_generation(session: Session, client: Client, *arguments: object) -> bool:
    """Generate a component, and say what came of it. Raises `NoDescription`."""
    if len(arguments) != 1 or not isinstance(arguments[0], str):
        raise NoDescription(f"`{GENERATE}` takes the URI of a CDSL file")
    outcome = await generate(session, session.path_of(arguments[0]))
    kind = lsp.MessageType.Info if outcome.done else lsp.MessageType.Error
    client.window_show_message(lsp.ShowMessageParams(kind, outcome.message))
    return outcome.done


async def show_references(session: Session, client: Client, *arguments: object) -> None:
    """Open the only place, or list all of them. Raises `NoDescription`."""
    places = _locations(arguments)
    can = client.client_capabilities.window
    if len(places) == 1 and can and can.show_document and can.show_document.support:
        one = places[0]
        params = lsp.ShowDocumentParams(one.uri, take_focus=True, selection=one.range)
        client.window_show_document(params)
        return
    lines = [f"{session.path_of(one.uri)}:{one.range.start.line + 1}" for one in places]
    more = [f"and {len(lines) - MOST_PLACES} more"] if len(lines) > MOST_PLACES else []
    said = "\n".join([*lines[:MOST_PLACES], *more]) or "nothing refers to it"
    client.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Info, said))


def _locations(arguments: tuple[object, ...]) -> list[lsp.Location]:
    try:
        _, _, places = arguments
        found: list[lsp.Location] = _converter.structure(places, list[lsp.Location])
    except Exception:
        raise NoDescription(
            f"`{SHOW_REFERENCES}` takes a URI, a position and a list of locations"
        ) from None
    return found


COMMANDS: Mapping[str, Callable[..., Awaitable[Any]]] = {
    GENERATE: run_generation,
    SHOW_REFERENCES: show_references,
}
