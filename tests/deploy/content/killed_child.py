"""Runs a function in a child that is killed at one of its steps in the file system."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import Any

STEPS = ("os.", "shutil.", "subprocess.")


def killed_at(
    step: int,
    function: Callable[[dict[str, Any]], object],
    request: dict[str, Any],
    steps: tuple[str, ...] = (*STEPS, "open"),
) -> bool:
    """Whether the child was killed; False if the function ended before that step.

    `steps` are beginnings of the names of audit events that count.
    """
    child = os.fork()
    if child == 0:
        _run(step, function, request, steps)
    _, status = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(status)
    assert code in (0, 9), "the function failed"
    return code == 9


def _run(
    step: int,
    function: Callable[[dict[str, Any]], object],
    request: dict[str, Any],
    steps: tuple[str, ...],
) -> None:
    count = 0

    def kill_at_step(event: str, _: object) -> None:
        nonlocal count
        if event.startswith(steps):
            count += 1
            if count == step:
                os._exit(9)

    try:
        sys.addaudithook(kill_at_step)
        function(request)
        os._exit(0)
    except BaseException as error:
        os.write(2, repr(error).encode())
    finally:
        os._exit(1)
