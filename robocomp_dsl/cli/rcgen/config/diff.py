"""`rcgen config diff`: compares the user's files with the installed ones.

In: a context, or one file of it. Out: a unified diff; exit code 1 if there are differences.
"""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterator
from pathlib import Path

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.config import lookup
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.runtime.config import files_of


@click.command()
@click.argument("context", type=lookup.CONTEXT)
@click.argument("file", required=False, type=lookup.FILE)
def command(context: str, file: str | None) -> None:
    """Compare your files of a context with the installed ones, as a unified diff."""
    folders = lookup.folders()
    lookup.require_context(context, folders.roots)
    own, installed = files_of(context, folders.own()), files_of(context, folders.installed())
    selected = lookup.select_file(own | installed, file)
    differ = False
    for name in sorted(selected.keys() & own.keys()):
        mine = own[name][0].folder / name
        if name not in installed:
            print(f"only yours: {mine}")
            continue
        lines = list(_difference(installed[name][0].folder / name, mine))
        differ |= bool(lines)
        options.write_text("".join(lines), sys.stdout)
    if file and file not in own:
        print(f"you have no `{file}` of your own; `rcgen config import {context} {file}` makes one")
    if differ:
        raise CliError(EXIT_FINDINGS)


def _difference(old: Path, new: Path) -> Iterator[str]:
    """Lines of a unified diff; none if the files are equal."""
    before, after = _bytes(old), _bytes(new)
    if before == after:
        return
    try:
        was, now = (data.decode("utf-8").splitlines(keepends=True) for data in (before, after))
    except UnicodeDecodeError:
        yield f"Binary files {old} and {new} differ\n"
        return
    for line in difflib.unified_diff(was, now, fromfile=str(old), tofile=str(new)):
        whole = line.endswith("\n")
        yield line if whole else f"{line}\n\\ No newline at end of file\n"


def _bytes(path: Path) -> bytes:
    try:
        return read_bytes(path)
    except OSError as error:
        raise CliError(
            EXIT_FINDINGS, f"`{path}` cannot be read: {error.strerror or error}"
        ) from None
