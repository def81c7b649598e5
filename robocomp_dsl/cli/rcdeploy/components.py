"""Requests about single components of a running deployment. In: a verb and names. Out: its reply.

The first name may be that of the deployment or its file; without it there must be only one that
runs.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy.engine import Engine, EngineError


def split_names(words: Sequence[str]) -> tuple[Engine, list[str]]:
    """The deployment that `words` mean, and the names of components and groups. Raises `CliError`.

    A first word that names a running deployment is that deployment, not a component of it.
    """
    first = words[0] if words else None
    if first is not None and not running.is_deployment(first):
        return running.resolve_deployment(None), list(words)
    return running.resolve_deployment(first), list(words[1:])


def request(engine: Engine, verb: str, names: Sequence[str]) -> None:
    """Send the request and print its replies. Raises `CliError` unless it succeeds."""
    try:
        code = engine.change(verb, names, running.say)
    except EngineError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if code:
        raise CliError(code)
