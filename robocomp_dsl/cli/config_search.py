"""What the sub-commands of `rcgen config` share: the folders, names from the command line, ends.

In: the environment. Out: `Folders`; a `UsageError` for names that lead elsewhere.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Never

import click

from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.runtime.config import (
    Origin,
    Place,
    Root,
    Surroundings,
    WrongName,
    checked_context,
    checked_file,
    context_names,
    dropped,
    surroundings,
)
from robocomp_dsl.runtime.parameters import Finding

output_format = click.option(
    "--format", "form", type=click.Choice(["text", "json"]), default="text", show_default=True
)


@dataclass(frozen=True, slots=True)
class Folders:
    """Where this machine has configurations; `roots` has those of drop-in files, too."""

    around: Surroundings
    roots: tuple[Root, ...]

    def installed(self) -> list[Root]:
        """Those that are nobody's own."""
        return [one for one in self.roots if one.origin in (Origin.INSTALLED, Origin.DROPPED)]

    def own(self) -> list[Root]:
        """Those of the user."""
        return [one for one in self.roots if one.origin is Origin.USER]


def folders() -> Folders:
    """All of them; drop-in files that cannot be used are told as warnings."""
    around = surroundings()
    findings: list[Finding] = []
    roots = (*around.roots, *dropped(around, findings))
    for one in findings:
        print(str(one).replace("error:", "warning:", 1), file=sys.stderr)
    return Folders(around, roots)


class Checked(click.ParamType[str]):
    """A word that `check` lets through; it raises `WrongName` for others."""

    def __init__(self, name: str, check: Callable[[str], object]) -> None:
        self.name = name
        self.check = check

    def convert(self, value: str, param: Any, ctx: Any) -> str:
        """`value` itself. Fails for what leads elsewhere."""
        try:
            self.check(value)
        except WrongName as error:
            self.fail(str(error), param, ctx)
        return value


CONTEXT = Checked("context", checked_context)
FILE = Checked("file", checked_file)


def known_context(name: str, roots: list[Root] | tuple[Root, ...]) -> str:
    """`name` itself; ends the program for one that no root has."""
    known = context_names(roots)
    if name not in known:
        guess = did_you_mean(name, known)
        fail(f"there is no context `{name}` here" + (f"; {guess}" if guess else ""))
    return name


def of_name(files: dict[str, list[Place]], name: str | None) -> dict[str, list[Place]]:
    """All of `files`, or the one called `name`; ends the program when there is none."""
    if name is None:
        return files
    if name not in files:
        guess = did_you_mean(name, files)
        fail(f"there is no `{name}` in it" + (f"; {guess}" if guess else ""))
    return {name: files[name]}


def fail(said: str) -> Never:
    """End with the code for findings."""
    print(f"error: {said}", file=sys.stderr)
    sys.exit(FINDINGS)


def shown(path: Path) -> str:
    """A path as people write it."""
    try:
        return f"~/{path.relative_to(Path.home())}"
    except (ValueError, RuntimeError):
        return str(path)
