"""Handlers that always answer: every failure becomes an error in the words of the user.

In: functions that may raise. Out: functions that raise only what the protocol has a code for.
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

from robocomp_dsl.editor.positions import WrongPosition
from robocomp_dsl.editor.session import NoDescription, Session, StillChecking

Feature = Callable[[Session, Any], Any]

_logger = logging.getLogger(__name__)


def answering(function: Feature, session: Session) -> Callable[[Any], Any]:
    """`function` for the one session of this server."""
    return lambda params: function(session, params)


def guarded(method: str, handler: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """`handler` with every failure made into an answer in the words of the user."""

    def run(params: Any) -> Any:
        with explained(method):
            return handler(params)

    return run


@contextmanager
def explained(method: str) -> Iterator[None]:
    """Make every failure inside an answer."""
    try:
        yield
    except JsonRpcException:
        raise
    except StillChecking as error:
        # Clients ask again after this answer, and show nothing.
        raise JsonRpcContentModified(str(error)) from None
    except (WrongPosition, NoDescription) as error:
        raise JsonRpcInvalidParams(str(error)) from None
    except Exception as error:
        what = f"internal error in {method}: {type(error).__name__}: {error}"
        _logger.debug("%s", what, exc_info=True)
        raise JsonRpcInternalError(what) from None
