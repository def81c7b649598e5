"""`rcgen config import`: copies installed configurations into the user's folder.

In: a context, or one file of it. Out: files in the user's folder, all or none; existing files are
kept without `--force`.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.config import lookup
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.runtime.config import CONTEXTS, context_names, files_of

Copy = tuple[Path, Path]
"""Source and target."""


@click.command()
@click.argument("context", type=lookup.CONTEXT)
@click.argument("file", required=False, type=lookup.FILE)
@click.option("--force", is_flag=True, help="Overwrite your own files.")
def command(context: str, file: str | None, *, force: bool) -> None:
    """Copy an installed context, or one file of it, into your own folder."""
    folders = lookup.folders()
    copies = _copies(folders, context, file)
    new = [copy for copy in copies if not _same(copy)]
    there = [target for _, target in new if target.exists() or target.is_symlink()]
    if there and not force:
        names = "".join(f"\n  {lookup.display_path(subcontext)}" for subcontext in there)
        raise CliError(
            EXIT_FINDINGS,
            f"nothing was copied, these are there already (--force overwrites):{names}",
        )
    try:
        _write(new, force=force)
    except OSError as error:
        reason = error.strerror or str(error)
        raise CliError(
            EXIT_FINDINGS, f"nothing was copied: {error.filename2 or error.filename}: {reason}"
        ) from None
    for source, target in copies:
        done = "wrote" if (source, target) in new else "is the same already:"
        print(f"{done} {lookup.display_path(target)}  (from {source})")


def _copies(folders: lookup.Folders, context: str, file: str | None) -> list[Copy]:
    """The files to copy: for each name, the installed file with the highest precedence."""
    installed = folders.installed()
    if context not in context_names(installed) and context in context_names(folders.roots):
        raise CliError(
            EXIT_FINDINGS, f"nothing of the context `{context}` is installed; what it has is yours"
        )
    lookup.require_context(context, installed)
    subcontexts = [
        subcontext
        for subcontext in context_names(installed)
        if f"{subcontext}/".startswith(f"{context}/")
    ]
    found = {}
    for subcontext in subcontexts:
        subfolder = subcontext[len(context) + 1 :]
        for name, places in files_of(subcontext, installed).items():
            found[f"{subfolder}/{name}" if subfolder else name] = places
    home = folders.around.data_home / CONTEXTS
    return [
        (places[0].folder / Path(name).name, home / context / name)
        for name, places in lookup.select_file(found, file).items()
    ]


def _same(copy: Copy) -> bool:
    try:
        return read_bytes(copy[0]) == read_bytes(copy[1])
    except OSError:
        return False


def _write(copies: Sequence[Copy], *, force: bool) -> None:
    """Write all new files or none, each atomically. Raises `OSError`."""
    ready: list[tuple[Path, Path]] = []
    created: list[Path] = []
    try:
        for source, target in copies:
            target.parent.mkdir(parents=True, exist_ok=True)
            ready.append((_beside(target), target))
            shutil.copyfile(source, ready[-1][0])
        for new, target in ready:
            if force:
                new.replace(target)
            else:  # unlike a rename, a link fails if the file exists meanwhile
                target.hardlink_to(new)
                created.append(target)
    except OSError:
        for target in created:
            target.unlink(missing_ok=True)
        raise
    finally:
        for new, _ in ready:
            with suppress(OSError):
                new.unlink(missing_ok=True)


def _beside(target: Path) -> Path:
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    mask = os.umask(0)
    os.umask(mask)
    os.fchmod(handle, 0o666 & ~mask)
    os.close(handle)
    return Path(name)
