"""`rcgen breaking`: what a change of descriptions breaks.

In: a folder or file, and an earlier version of it: a git revision or another folder. Out: findings;
the exit code is 1 where peers, code, configurations or deployments break.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import click

from robocomp_dsl.check import check_file
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.breaking_deployments import judge
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.compare import Version, compare
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.source import Source, Span

SUFFIXES = (".idsl", ".cdsl", ".pdsl")
DEPLOYMENTS = ".ddsl"
NEEDED = (*SUFFIXES, DEPLOYMENTS, ".smdsl", ".scxml", ".yaml", ".yml", ".toml")
"""What is taken out of an archive: descriptions, and what they name."""
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
    """List the changes that break peers, code, configurations or deployments, with their kinds.

    RC641 breaks peers on the wire, RC642 code, RC643 configurations; RC644 changes a meaning;
    RC645 breaks the wiring of a deployment, RC646 parameter values of one.
    """
    if not path.exists():
        options.complain(f"there is no `{path}`")
        sys.exit(FINDINGS)
    if path.is_file() and path.suffix.lower() not in (*SUFFIXES, DEPLOYMENTS):
        listed = ", ".join((*SUFFIXES, DEPLOYMENTS))
        options.complain(f"`{path}` is none of the files that are compared: {listed}")
        sys.exit(FINDINGS)
    found = Report()
    try:
        with _earlier(path, against) as before:
            unread, report = Report(), Report()
            then, now = before.folders(folders), (*folders, _root(path))
            old, new = _version(before.path, then, unread), _version(path, now, report)
            deployments = [
                judge(one, before.then(one), now, then) for one in _files(path, (DEPLOYMENTS,))
            ]
            report.extend(d for one in deployments for d in one.own)
            if report.failed:
                options.show(report.sorted(), form, sys.stderr)
                options.complain("mend these first; only what is right can be compared")
                sys.exit(FINDINGS)
            _tell_unread(unread, before)
            wired = [one.deployment for one in deployments if one.deployment]
            compare(old, new, wired, found)
            found.extend(d for one in deployments for d in one.broken)
            named = [before.named(one) for one in found.sorted()]
    except NoSuchVersion as error:
        options.complain(str(error))
        sys.exit(FINDINGS)
    options.show(named, form, sys.stdout)
    if form == "full":
        print(f"{path} against {against}: {options.summary(named)}")
    sys.exit(FINDINGS if found.failed else 0)


@dataclass(frozen=True, slots=True)
class _Earlier:
    """Where the earlier version is: `path` of it, its whole tree `root` and that of the new one.

    With a `revision` the tree is a copy that is soon gone, and places in it are told as git does:
    `v1:sub/Laser.idsl`.
    """

    path: Path
    root: Path
    new_root: Path
    revision: str = ""

    def folders(self, given: tuple[Path, ...]) -> tuple[Path, ...]:
        """Folders within the tree as they were; others are the same for both."""
        return (*(self.then(one) or one for one in given), _root(self.path))

    def then(self, one: Path) -> Path | None:
        """Where a file or folder was; None for one that is not in the tree."""
        new, whole = self.new_root.resolve(), one.resolve()
        return self.root / whole.relative_to(new) if whole.is_relative_to(new) else None

    def named(self, one: Diagnostic) -> Diagnostic:
        """With places that the user can look up."""
        notes = tuple(n.replaced(span=self._span(n.span)) if n.span else n for n in one.notes)
        return one.replaced(span=self._span(one.span), notes=notes)

    def _span(self, span: Span) -> Span:
        if not self.revision or not span.source.path.is_relative_to(self.root):
            return span
        return Source(self.name(span.source.path), span.source.text).span(span.start, span.end)

    def name(self, path: Path) -> Path:
        """What a file of the earlier version is called."""
        inside = path.relative_to(self.root) if self.revision else path
        return Path(f"{self.revision}:{inside}") if self.revision else path


def _tell_unread(unread: Report, before: _Earlier) -> None:
    """What was broken in the earlier version cannot break any more."""
    paths = sorted({before.name(one.span.source.path) for one in unread})
    if paths:
        listed = ", ".join(f"`{one}`" for one in paths[:5])
        more = f" and {len(paths) - 5} more" if len(paths) > 5 else ""
        said = f"{listed}{more} had errors in the earlier version"
        options.complain(f"{said}; what was not understood of it is not compared")


def _version(path: Path, folders: tuple[Path, ...], report: Report) -> Version:
    """All models at `path`; `report` gets the errors only."""
    workspace = Workspace(folders)
    version = Version()
    for one in _files(path, SUFFIXES):
        found = Report()
        version.add(check_file(one, workspace, found))
        report.extend(d for d in found if d.severity is Severity.ERROR)
    return version


def _root(path: Path) -> Path:
    return path if path.is_dir() else path.parent


def _files(path: Path, suffixes: Collection[str]) -> list[Path]:
    if path.is_file():
        return [path] if path.suffix.lower() in suffixes else []
    return sorted(
        p
        for p in path.rglob("*")
        if p.suffix.lower() in suffixes and not SKIPPED & set(p.relative_to(path).parts)
    )


@contextmanager
def _earlier(path: Path, against: str) -> Iterator[_Earlier]:
    """The earlier version. Raises `NoSuchVersion`."""
    where = path if path.is_dir() else path.parent
    folder = Path(against)
    if against and folder.is_dir():
        yield _Earlier(folder if path.is_dir() else folder / path.name, folder, where)
        return
    if not against or against.startswith("-"):
        raise NoSuchVersion(f"`{against}` is neither a git revision nor a folder")
    top = Path(_git(where, "rev-parse", "--show-toplevel").decode().strip())
    revision = _git(where, "rev-parse", "--verify", "--quiet", f"{against}^{{commit}}")
    data = _git(top, "archive", "--format=tar", revision.decode().strip())
    with tempfile.TemporaryDirectory() as made:
        root = Path(made).resolve()
        _unpack(data, root)
        inside = path.resolve().relative_to(top.resolve())
        yield _Earlier(root / inside, root, top, against)


def _unpack(data: bytes, folder: Path) -> None:
    """The descriptions of an archive (Python 3.11.2 has no safe way of its own to unpack one)."""
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        for member in archive:
            content = archive.extractfile(member) if member.isfile() else None
            path = folder / member.name
            inside = path.resolve().is_relative_to(folder)
            if content and inside and path.suffix.lower() in NEEDED:
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
