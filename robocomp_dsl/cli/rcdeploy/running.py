"""Selects a running deployment. In: a name, a file or nothing. Out: its `Engine`."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.deploy import deployments
from robocomp_dsl.deploy.engine import Engine, EngineError
from robocomp_dsl.diagnostics import did_you_mean

say = partial(print, flush=True)
which = click.argument("which", metavar="[APP.ddsl|NAME]", required=False)


def resolve_deployment(which: str | None) -> Engine:
    """The running deployment with that name or file, or the only one. Raises `CliError`."""
    known = _known()
    matches = [e for e in known if which is None or deployments.is_meant(e, which)]
    if not matches and which is not None and (hosted := _hosted(which)):
        return hosted
    if len(matches) != 1:
        raise CliError(EXIT_FINDINGS, _selection_problem(which, matches, known))
    return matches[0]


def all_deployments() -> list[Engine]:
    """All running deployments of this user. Raises `CliError` if there is none."""
    known = _known()
    if not known:
        raise CliError(EXIT_FINDINGS, _selection_problem(None, [], []))
    return known


def is_deployment(word: str) -> bool:
    """Whether `word` names a deployment that runs or is on hosts, or a DDSL file.

    Raises `CliError`.
    """
    if word.lower().endswith(".ddsl"):
        return True
    if any(deployments.is_meant(engine, word) for engine in _known()):
        return True
    return deployments.find_hosted(word) is not None


def is_running(word: str) -> bool:
    """Whether `word` is the name of a running deployment, and not also of its components."""
    found = [engine for engine in _known() if engine.name == word]
    return bool(found) and word not in components(found[0])


def _hosted(which: str) -> Engine | None:
    """A deployment over hosts that was stopped, or that another operator has started."""
    if stopped := deployments.find_hosted(which):
        return stopped
    path = Path(which)
    if path.suffix != ".ddsl" or not path.is_file():
        return None
    from robocomp_dsl.cli.rcdeploy import app  # noqa: PLC0415 - loads the parser

    checked = app.check(path, ())
    if checked.plan is None or checked.deployment is None or not checked.hosted:
        return None
    return deployments.described_engine(checked.deployment, checked.plan)


def _known() -> list[Engine]:
    try:
        return deployments.running_deployments()
    except EngineError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


def _selection_problem(
    which: str | None, matches: Sequence[Engine], known: Sequence[Engine]
) -> str:
    names = ", ".join(f"{engine.name} ({engine.summary()})" for engine in matches or known)
    if matches:
        return f"several deployments are running: {names}; select one by name"
    what = f"`{which}` is not running" if which else "no deployment is running"
    return what + (f"; running: {names}" if names else "")


def components(engine: Engine) -> list[str]:
    """The full names of its components and programs. Raises `CliError`."""
    try:
        return engine.components()
    except EngineError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


def answering_components(engine: Engine) -> list[str]:
    """The full names of its components, without the programs. Raises `CliError`."""
    try:
        return engine.answering_components()
    except EngineError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


def resolve_component(name: str, known: Sequence[str]) -> str:
    """The full name of a component, given with or without its prefix. Raises `CliError`."""
    found = [
        deployment for deployment in known if name in (deployment, deployment.rpartition("/")[2])
    ]
    exact = [deployment for deployment in found if deployment == name]
    if len(exact or found) == 1:
        return (exact or found)[0]
    hint = did_you_mean(name, known) or f"it has {', '.join(known)}"
    raise CliError(EXIT_FINDINGS, f"there is no component `{name}` in the deployment; {hint}")
