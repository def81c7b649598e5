"""Selects a running deployment. In: a name, a file or nothing. Out: a `RunningDeployment`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.deploy import control, instances
from robocomp_dsl.diagnostics import did_you_mean

which = click.argument("which", metavar="[APP.ddsl|NAME]", required=False)


def resolve_deployment(which: str | None) -> instances.RunningDeployment:
    """The running deployment with that name or file, or the only one. Raises `CliError`."""
    try:
        known = instances.running()
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    matches = [deployment for deployment in known if which is None or is_meant(deployment, which)]
    if len(matches) != 1:
        raise CliError(EXIT_FINDINGS, _selection_problem(which, matches, known))
    return matches[0]


def all_deployments() -> list[instances.RunningDeployment]:
    """All running deployments of this user. Raises `CliError` if there is none."""
    try:
        known = instances.running()
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if not known:
        raise CliError(EXIT_FINDINGS, _selection_problem(None, [], []))
    return known


def is_deployment(word: str) -> bool:
    """Whether `word` names a running deployment, or a DDSL file. Raises `CliError`."""
    if word.lower().endswith(".ddsl"):
        return True
    try:
        return any(is_meant(deployment, word) for deployment in instances.running())
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


def is_running(word: str) -> bool:
    """Whether `word` is the name of a running deployment, and not also of its components."""
    try:
        found = [deployment for deployment in instances.running() if deployment.name == word]
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    return bool(found) and word not in components(found[0])


def _selection_problem(
    which: str | None,
    matches: list[instances.RunningDeployment],
    known: list[instances.RunningDeployment],
) -> str:
    names = ", ".join(
        f"{deployment.name} (pid {deployment.pid})" for deployment in matches or known
    )
    if matches:
        return f"several deployments are running: {names}; select one by name"
    what = f"`{which}` is not running" if which else "no deployment is running"
    return what + (f"; running: {names}" if names else "")


def is_meant(deployment: instances.RunningDeployment, which: str) -> bool:
    """Whether `which` is its name or its file."""
    return which == deployment.name or str(Path(which).resolve()) == deployment.path


def components(deployment: instances.RunningDeployment) -> list[str]:
    """The full names of its components and programs, and of groups that are one process."""
    rows = _status(deployment)["rows"]
    return [name for row in rows for name in (str(row["name"]), *_members(row))]


def answering_components(deployment: instances.RunningDeployment) -> list[str]:
    """The full names of its components, without the programs, which answer no calls."""
    status = _status(deployment)
    names = [name for row in status["rows"] for name in _members(row) or (str(row["name"]),)]
    return [name for name in names if name not in status.get("programs", ())]


def _members(row: Mapping[str, Any]) -> list[str]:
    """The components of a group that is one process."""
    return [name for name, _ in row.get("members", ())]


def _status(deployment: instances.RunningDeployment) -> dict[str, Any]:
    """The reply of the deployment's rcdeploy. Raises `CliError`."""
    try:
        return next(control.send_request(deployment.name, {"verb": "status"}))
    except (instances.Unavailable, StopIteration):
        raise CliError(
            EXIT_FINDINGS, f"`{deployment.name}` does not answer; it may be ending"
        ) from None


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
