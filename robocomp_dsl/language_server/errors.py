"""Error handling of requests: every exception becomes an error response with a clear message.

In: functions that may raise. Out: functions that raise only errors of the protocol.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from pygls.exceptions import (
    JsonRpcContentModified,
    JsonRpcException,
    JsonRpcInternalError,
    JsonRpcInvalidParams,
)

from robocomp_dsl.language_server.positions import InvalidPosition
from robocomp_dsl.language_server.session import CheckPending, Session, UnsupportedDocument

Feature = Callable[[Session, Any], Any]

_logger = logging.getLogger(__name__)


def bind_session(function: Feature, session: Session) -> Callable[[Any], Any]:
    """`function` with the session of this server as its first argument."""
    return lambda params: function(session, params)


def guard(method: str, handler: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """`handler` with its exceptions translated by `translate_errors`."""

    def run(params: Any) -> Any:
        with translate_errors(method):
            return handler(params)

    return run


@contextmanager
def translate_errors(method: str) -> Iterator[None]:
    """Translate every exception of the block into an error of the protocol."""
    try:
        yield
    except JsonRpcException:
        raise
    except CheckPending as error:
        # Clients repeat a request after this response, and show no message.
        raise JsonRpcContentModified(str(error)) from None
    except (InvalidPosition, UnsupportedDocument) as error:
        raise JsonRpcInvalidParams(str(error)) from None
    except Exception as error:
        message = f"internal error in {method}: {type(error).__name__}: {error}"
        _logger.debug("%s", message, exc_info=True)
        raise JsonRpcInternalError(message) from None
