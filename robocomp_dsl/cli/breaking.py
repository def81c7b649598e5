"""`rcgen breaking`: what a change of descriptions breaks.

In: a folder or file, and an earlier version of it: a git revision or another folder. Out: findings;
the exit code is 1 where peers, code or configurations break.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import click

from robocomp_dsl.check import check_file
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.compare import Version, compare
from robocomp_dsl.diagnostics import Report, Severity

SUFFIXES = (".idsl", ".cdsl", ".pdsl")
GIT_PATIENCE_S = 60.0
SKIPPED = {".git", ".venv", "node_modules", "build", ".rcgen"}


class NoSuchVersion(Exception):
    """The earlier version is not to be had; the message says why."""


@click.command()
@click.argument("path", type=click.Path(path_type=Path), default=".", metavar="[FOLDER|FILE]")
@click.option(
    "--against",
    required=True,
    metavar="REV|DIR",
    help="What to compare with: a git revision, or a folder with the earlier version.",
)
@options.output_format
@options.folders
def command(*, path: Path, against: str, form: str, folders: tuple[Path, ...]) -> None:
    """List the changes that break peers, code or configurations, with the kind of each.

    RC641 breaks peers on the wire, RC642 code, RC643 configurations; RC644 changes a meaning.
    """
    if not path.exists():
        options.complain(f"there is no `{path}`")
        sys.exit(FINDINGS)
    report = Report()
    try:
        with _earlier(path, against) as before:
            old = _version(before, folders, Report(), before)
            new = _version(path, folders, report, path)
            if report.failed:
                options.show(report.sorted(), form, sys.stderr)
                options.complain("mend these first; only what is right can be compared")
                sys.exit(FINDINGS)
            found = Report()
            compare(old, new, found)
            options.show(found.sorted(), form, sys.stdout)
    except NoSuchVersion as error:
        options.complain(str(error))
        sys.exit(FINDINGS)
    if form == "full":
        print(f"{path} against {against}: {options.summary(found.sorted())}")
    sys.exit(FINDINGS if found.failed else 0)


def _version(path: Path, folders: tuple[Path, ...], report: Report, root: Path) -> Version:
    """All models at `path`. Only errors of the new version matter."""
    workspace = Workspace((*folders, root if root.is_dir() else root.parent))
    version = Version()
    for one in _files(path):
        found = Report()
        version.add(check_file(one, workspace, found))
        report.extend(d for d in found if d.severity is Severity.ERROR)
    return version


def _files(path: Path) -> list[Path]:
    if path.is_file():
        return [path]
    return sorted(
        p
        for p in path.rglob("*")
        if p.suffix.lower() in SUFFIXES and not SKIPPED & set(p.relative_to(path).parts)
    )


@contextmanager
def _earlier(path: Path, against: str) -> Iterator[Path]:
    """Where the earlier version is. Raises `NoSuchVersion`."""
    folder = Path(against)
    if folder.is_dir():
        yield folder if path.is_dir() else folder / path.name
        return
    where = path if path.is_dir() else path.parent
    top = Path(_git(where, "rev-parse", "--show-toplevel").decode().strip())
    revision = _git(where, "rev-parse", "--verify", "--quiet", f"{against}^{{commit}}")
    data = _git(top, "archive", "--format=tar", revision.decode().strip())
    with tempfile.TemporaryDirectory() as made:
        _unpack(data, Path(made))
        inside = path.resolve().relative_to(top.resolve())
        yield Path(made) / inside


def _unpack(data: bytes, folder: Path) -> None:
    """The descriptions of an archive; links are left out, they may lead anywhere."""
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        for member in archive:
            content = archive.extractfile(member) if member.isfile() else None
            path = folder / member.name
            inside = path.resolve().is_relative_to(folder.resolve())
            if content and inside and path.suffix.lower() in SUFFIXES:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content.read())


def _git(where: Path, *arguments: str) -> bytes:
    try:
        run = subprocess.run(  # noqa: S603 - git, found as the user's shell finds it
            ["git", *arguments],  # noqa: S607
            cwd=where,
            capture_output=True,
            timeout=GIT_PATIENCE_S,
            check=False,
        )
    except FileNotFoundError:
        raise NoSuchVersion("git is not installed; give a folder to compare with") from None
    except subprocess.TimeoutExpired:
        raise NoSuchVersion(f"`git {arguments[0]}` did not end within a minute") from None
    if run.returncode:
        said = run.stderr.decode("utf-8", "replace").strip()
        wrong = said or "there is neither such a git revision nor such a folder"
        raise NoSuchVersion(f"cannot compare: {wrong}")
    return run.stdout
