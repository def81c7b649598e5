"""Lookup of contexts and files for the sub-commands of `rcgen config`.

In: the environment and names from the command line. Out: `Folders`, validated names, `CliError`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.finding import Finding
from robocomp_dsl.runtime.config import (
    InvalidName,
    Origin,
    Root,
    SearchEnvironment,
    SearchPath,
    context_names,
    drop_in_roots,
    validate_context,
    validate_file,
)

output_format = click.option(
    "--format",
    "output_format",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
)


@dataclass(frozen=True, slots=True)
class Folders:
    """The configuration folders of this machine; `roots` includes those of drop-in files."""

    around: SearchEnvironment
    roots: tuple[Root, ...]

    def installed(self) -> list[Root]:
        """The roots of installed packages."""
        return [root for root in self.roots if root.origin in (Origin.INSTALLED, Origin.DROP_IN)]

    def own(self) -> list[Root]:
        """The roots of the user."""
        return [root for root in self.roots if root.origin is Origin.USER]


def folders() -> Folders:
    """All folders; drop-in files that cannot be used are reported as warnings."""
    around = SearchEnvironment.from_environ()
    findings: list[Finding] = []
    roots = (*around.roots, *drop_in_roots(around, findings))
    for finding in findings:
        print(finding.render("warning"), file=sys.stderr)
    return Folders(around, roots)


class ValidatedName(click.ParamType[str]):
    """A name that `check` accepts; `check` raises `InvalidName` for others."""

    def __init__(self, name: str, check: Callable[[str], object]) -> None:
        self.name = name
        self.check = check

    def convert(self, value: str, param: Any, ctx: Any) -> str:
        """`value` itself. Fails for a name outside the folder."""
        try:
            self.check(value)
        except InvalidName as error:
            self.fail(str(error), param, ctx)
        return value


CONTEXT = ValidatedName("context", validate_context)
FILE = ValidatedName("file", validate_file)


def require_context(name: str, roots: list[Root] | tuple[Root, ...]) -> str:
    """`name` itself. Raises `CliError` if no root has this context."""
    known = context_names(roots)
    if name not in known:
        guess = did_you_mean(name, known)
        raise CliError(
            EXIT_FINDINGS, f"there is no context `{name}` here" + (f"; {guess}" if guess else "")
        )
    return name


def select_file(
    files: dict[str, list[SearchPath]], name: str | None
) -> dict[str, list[SearchPath]]:
    """All of `files`, or the one called `name`. Raises `CliError` if there is none."""
    if name is None:
        return files
    if name not in files:
        guess = did_you_mean(name, files)
        raise CliError(
            EXIT_FINDINGS, f"there is no `{name}` in it" + (f"; {guess}" if guess else "")
        )
    return {name: files[name]}


def display_path(path: Path) -> str:
    """A path with `~` for the home folder."""
    try:
        return f"~/{path.relative_to(Path.home())}"
    except (ValueError, RuntimeError):
        return str(path)
