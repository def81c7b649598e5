"""Reads requests from standard input and answers them, until the input ends.

In: a line with the JSON of a request, then its `payload`. Out: a line with the number of lines that
follow, which are the pieces of the JSON answer.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import Any, BinaryIO

LINE = 32_000
"""Characters per line of an answer; some readers have a limit of 64 KiB."""

Answer = Callable[[dict[str, Any]], dict[str, Any]]


def serve(functions: dict[str, Any], requests: BinaryIO, answers: BinaryIO) -> None:
    """Answer each request with the function of its name."""
    while line := requests.readline():
        request = json.loads(line)
        request["payload"] = requests.read(request["payload_bytes"])
        if len(request["payload"]) < request["payload_bytes"]:
            return  # rcdeploy ended
        function: Answer = functions[request["function"]]
        text = json.dumps(_answer(function, request))
        pieces = [text[start : start + LINE] for start in range(0, len(text), LINE)]
        answers.write("\n".join([str(len(pieces)), *pieces, ""]).encode())
        answers.flush()


def _answer(function: Answer, request: dict[str, Any]) -> dict[str, Any]:
    try:
        return {"answer": function(request)}
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        return {"error": f"{place}{error.strerror or error}", "errno": error.errno or 0}
    except Exception as error:
        kind = getattr(error, "kind", type(error).__name__)
        return {"error": str(error), "kind": kind}


def main() -> None:
    """Serve the functions of this namespace."""
    serve(globals(), sys.stdin.buffer, sys.stdout.buffer)
