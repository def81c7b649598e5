"""Which running deployment a command means. In: a name, a file or nothing. Out: a `Running`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Never

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.deploy import control, folder
from robocomp_dsl.diagnostics import did_you_mean

which = click.argument("which", metavar="[APP.ddsl|NAME]", required=False)


def find(which: str | None) -> folder.Running:
    """The running deployment of that name or file, or the only one; else says so and exits 1."""
    try:
        known = folder.running()
    except folder.Unavailable as error:
        fail(str(error))
    meant = [one for one in known if which is None or _is(one, which)]
    if len(meant) != 1:
        fail(_unclear(which, meant, known))
    return meant[0]


def _unclear(which: str | None, meant: list[folder.Running], known: list[folder.Running]) -> str:
    listed = ", ".join(f"{one.name} (pid {one.pid})" for one in meant or known)
    if meant:
        return f"several deployments are running: {listed}; say which one by its name"
    what = f"`{which}` is not running" if which else "no deployment is running"
    return what + (f"; running: {listed}" if listed else "")


def _is(one: folder.Running, which: str) -> bool:
    return which == one.name or str(Path(which).resolve()) == one.path


def components(one: folder.Running) -> list[str]:
    """The whole names of its components."""
    try:
        answer = next(control.ask(one.name, {"verb": "status"}))
    except (folder.Unavailable, StopIteration):
        fail(f"`{one.name}` does not answer; it may be ending")
    return [str(row["name"]) for row in answer["rows"]]


def meant(name: str, known: Sequence[str]) -> str:
    """The component that is called so, with its prefix or without; else says so and exits 1."""
    found = [one for one in known if name in (one, one.rpartition("/")[2])]
    exact = [one for one in found if one == name]
    if len(exact or found) == 1:
        return (exact or found)[0]
    hint = did_you_mean(name, known) or f"it has {', '.join(known)}"
    return fail(f"there is no component `{name}` in the deployment; {hint}")


def fail(message: str) -> Never:
    """Say why it does not work, and exit 1."""
    options.complain(message)
    sys.exit(FINDINGS)
