"""Why a message could not be built or sent, in the user's words and with the place in the bridge.

In: an exception and the field that was computed. Out: a `MessageFailure`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from robocomp_dsl.runtime.bridge.errors import DoesNotFit
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.errors import EncodeError, MiddlewareError

NOT_FITTING = "a value does not fit"
NOT_SENT = "the middleware could not send it"
FAILED = "building it failed"


class MessageFailure(NamedTuple):
    """`reason` is the key of the counts, `text` the details, `place` is `file:line`."""

    reason: str
    text: str
    place: str


def describe_failure(error: Exception, field: str, places: Mapping[str, str]) -> MessageFailure:
    """The failure of one message; `field` was computed last, `places` are by path."""
    if isinstance(error, EncodeError):
        # The message is complete: the codec knows the field.
        path = error.path.partition(".")[2] if error.path not in places else error.path
        text = f"{path}: {error.reason}" if path else error.reason
        return MessageFailure(NOT_FITTING, text, place_of(path, places))
    place = place_of(field, places)
    prefix = f"{field}: " if field else ""
    if isinstance(error, DoesNotFit):
        return MessageFailure(NOT_FITTING, f"{prefix}{error}", place)
    if isinstance(error, MiddlewareError):
        return MessageFailure(NOT_SENT, str(error), places.get("", ""))
    return MessageFailure(FAILED, f"{prefix}{describe_error(error)}", place)


def place_of(path: str, places: Mapping[str, str]) -> str:
    """The place of the assignment of the field `path`, or of a field that contains it."""
    while path and path not in places:
        path = path[: max(path.rfind("."), path.rfind("["), 0)]
    return places.get(path, "")
