"""`rcgen config import`: own copies of installed configurations.

In: a context, or one file of it. Out: files in the user's folder, all of them or none; what is
there already stays, unless `--force` is given.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import click

from robocomp_dsl.cli import config_search as searching
from robocomp_dsl.runtime.config import CONTEXTS, context_names, files_of

Copy = tuple[Path, Path]
"""From where to where."""


@click.command()
@click.argument("context", type=searching.CONTEXT)
@click.argument("file", required=False, type=searching.FILE)
@click.option("--force", is_flag=True, help="Overwrite files of yours.")
def command(context: str, file: str | None, *, force: bool) -> None:
    """Copy an installed context, or one file of it, into your own folder."""
    folders = searching.folders()
    copies = _copies(folders, context, file)
    new = [one for one in copies if not _same(one)]
    there = [target for _, target in new if target.exists() or target.is_symlink()]
    if there and not force:
        listed = "".join(f"\n  {searching.shown(one)}" for one in there)
        searching.fail(f"nothing was copied, these are there already (--force overwrites):{listed}")
    try:
        _write(new, force=force)
    except OSError as error:
        said = error.strerror or str(error)
        searching.fail(f"nothing was copied: {error.filename2 or error.filename}: {said}")
    for source, target in copies:
        done = "wrote" if (source, target) in new else "is the same already:"
        print(f"{done} {searching.shown(target)}  (from {source})")


def _copies(folders: searching.Folders, context: str, file: str | None) -> list[Copy]:
    """What is to be copied: of each name the installed file that wins among the installed ones."""
    installed = folders.installed()
    if context not in context_names(installed) and context in context_names(folders.roots):
        searching.fail(f"nothing of the context `{context}` is installed; what it has is yours")
    searching.known_context(context, installed)
    inside = [one for one in context_names(installed) if f"{one}/".startswith(f"{context}/")]
    found = {}
    for one in inside:
        way = one[len(context) + 1 :]
        for name, places in files_of(one, installed).items():
            found[f"{way}/{name}" if way else name] = places
    home = folders.around.data_home / CONTEXTS
    return [
        (places[0].folder / Path(name).name, home / context / name)
        for name, places in searching.of_name(found, file).items()
    ]


def _same(copy: Copy) -> bool:
    try:
        return copy[0].read_bytes() == copy[1].read_bytes()
    except OSError:
        return False


def _write(copies: Sequence[Copy], *, force: bool) -> None:
    """All, or none of those that were not there; each appears whole. Raises `OSError`."""
    ready: list[tuple[Path, Path]] = []
    made: list[Path] = []
    try:
        for source, target in copies:
            target.parent.mkdir(parents=True, exist_ok=True)
            ready.append((_beside(target), target))
            shutil.copyfile(source, ready[-1][0])
        for new, target in ready:
            if force:
                new.replace(target)
            else:  # a link, other than a rename, fails where a file has appeared meanwhile
                target.hardlink_to(new)
                made.append(target)
    except OSError:
        for target in made:
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
