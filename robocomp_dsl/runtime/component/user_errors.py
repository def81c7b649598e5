"""Exceptions of user code: their location in the component's folder, and how they are logged.

In: an exception. Out: a message with the innermost line of user code. The traceback is logged, too,
if the component was started with `--traceback` or the variable `ROBOCOMP_TRACEBACK`.
"""

from __future__ import annotations

import logging
import os
import sys
import traceback
from pathlib import Path

from robocomp_dsl.runtime.errors import ReportedFailure

TRACEBACK_VARIABLE = "ROBOCOMP_TRACEBACK"
HINT = " [--traceback shows the calls]"

log = logging.getLogger("robocomp")
_PACKAGE = str(Path(__file__).parents[2])
_STANDARD_LIBRARY = str(Path(os.__file__).parent)
_INSTALLED = {"site-packages", "dist-packages"}
_user_folders: set[str] = set()


def add_user_folder(cls: type) -> None:
    """Errors are located in the folder of the module of `cls`, a worker, if possible."""
    file = getattr(sys.modules.get(cls.__module__), "__file__", None)
    if file:
        _user_folders.add(f"{Path(file).resolve().parent}{os.sep}")


def log_error(message: str, error: BaseException) -> None:
    """Log an error of user code: `message` is complete; the traceback follows if requested."""
    if os.environ.get(TRACEBACK_VARIABLE):
        log.error("%s", message, exc_info=error)
    else:
        log.error("%s%s", message, HINT if error.__traceback__ else "")


def log_failure(what: str, error: BaseException) -> None:
    """Log that `what` failed with an exception of user code."""
    log_error(f"{what} failed: {describe_error(error)}", error)


def describe_error(error: BaseException) -> str:
    """`Type: message (file:line)`, with the innermost location in user code.

    A `ReportedFailure` has its place in its message.
    """
    if isinstance(error, ReportedFailure):
        return message_of(error)
    location = user_location(traceback.extract_tb(error.__traceback__))
    message = message_of(error)
    text = f"{type(error).__name__}: {message}" if message else type(error).__name__
    return f"{text} ({location})" if location else text


def message_of(error: BaseException) -> str:
    """`str(error)`; a `__str__` of user code that raises itself counts as no message."""
    try:
        return str(error)
    except Exception:
        return ""


def user_location(frames: traceback.StackSummary) -> str:
    """`file:line` of the innermost frame in the component's folder; "" without frames.

    If no frame is there: of the innermost in other user code, else of the innermost of all.
    """
    user_frames = [frame for frame in frames if not is_library_code(frame.filename)]
    own = [frame for frame in user_frames if _is_in_user_folder(frame.filename)]
    frame = next(iter((own or user_frames or list(frames))[-1:]), None)
    return f"{frame.filename}:{frame.lineno}" if frame else ""


def is_library_code(file: str) -> bool:
    """Whether a file is library code: Python, installed packages, robocomp_dsl, generated code."""
    if file.startswith((_STANDARD_LIBRARY, _PACKAGE, "<")):
        return True
    path = Path(file)
    return path.parent.name.endswith("_generated") or not _INSTALLED.isdisjoint(path.parts)


def _is_in_user_folder(file: str) -> bool:
    return str(Path(file).resolve()).startswith(tuple(_user_folders))
