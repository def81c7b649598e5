"""`rcgen breaking`: reports breaking changes of descriptions.

In: a folder or file, and an earlier version of it: a git revision or another folder. Out: findings;
the exit code is 1 if peers, code, configurations or deployments break.
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

from robocomp_dsl.breaking.compare import Version, compare
from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.output.left_out import describe_left_out
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.breaking_deployments import check_deployment
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.definitions import DEFINITION_SUFFIXES

SUFFIXES = (".idsl", ".cdsl", ".pdsl")
DEPLOYMENTS = ".ddsl"
_NAMED = (".smdsl", ".scxml", ".yaml", ".yml", ".toml", *DEFINITION_SUFFIXES)
ARCHIVED_SUFFIXES = (*SUFFIXES, DEPLOYMENTS, *_NAMED)
"""The files extracted from an archive: descriptions, and the files that they name."""
GIT_TIMEOUT_S = 60.0
SKIPPED_FOLDERS = {".git", ".venv", "node_modules", "build", ".rcgen"}


class VersionNotFound(Exception):
    """The earlier version does not exist or cannot be read; the message gives the reason."""


@click.command()
@click.argument("path", type=click.Path(path_type=Path), default=".", metavar="[FOLDER|FILE]")
@click.option(
    "--against",
    required=True,
    metavar="REV|DIR",
    help="The earlier version: a git revision, or a folder.",
)
@options.output_format
@options.folders
def command(*, path: Path, against: str, output_format: str, folders: tuple[Path, ...]) -> None:
    """List breaking changes for peers, code, configurations and deployments.

    RC641 breaks communication with peers, RC642 user code, RC643 configurations; RC644 changes a
    meaning; RC645 breaks a connection of a deployment, RC646 its parameter values.
    """
    if not path.exists():
        raise CliError(EXIT_FINDINGS, f"there is no `{path}`")
    if path.is_file() and path.suffix.lower() not in (*SUFFIXES, DEPLOYMENTS):
        names = ", ".join((*SUFFIXES, DEPLOYMENTS))
        raise CliError(EXIT_FINDINGS, f"`{path}` is none of the files that are compared: {names}")
    found = Report()
    try:
        with _open_earlier_version(path, against) as before:
            unread, report = Report(), Report()
            old_folders, now = before.folders(folders), (*folders, _root(path))
            new, left_out = _version(path, now, report)
            not_compared = {before.old_path(file) for file in left_out}
            old, _ = _version(before.path, old_folders, unread, not_compared)
            deployments = [
                check_deployment(file, before.old_path(file), now, old_folders)
                for file in _files(path, (DEPLOYMENTS,))
            ]
            for deployment in deployments:
                report.extend(deployment.own)
            count = len(_files(path, (*SUFFIXES, DEPLOYMENTS)))
            left_out += [
                file
                for file, deployment in zip(_files(path, (DEPLOYMENTS,)), deployments, strict=True)
                if any(d.severity is Severity.ERROR for d in deployment.own)
            ]
            if left_out:
                options.print_findings(report.sorted(), output_format, sys.stderr)
                if len(left_out) == count:
                    message = "fix these errors first; files with errors cannot be compared"
                    raise CliError(EXIT_FINDINGS, message)
                options.print_error(describe_left_out(left_out, count, "compared"))
            _report_unread(unread, before)
            current_deployments = [
                deployment.deployment for deployment in deployments if deployment.deployment
            ]
            compare(old, new, current_deployments, found)
            found.extend(d for deployment in deployments for d in deployment.broken)
            named = [before.with_names(item) for item in found.sorted()]
    except VersionNotFound as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    options.print_findings(named, output_format, sys.stdout)
    if output_format == "full":
        print(f"{path} against {against}: {options.summary(named)}")
    if found.has_errors or left_out:
        raise CliError(EXIT_FINDINGS)


@dataclass(frozen=True, slots=True)
class _EarlierVersion:
    """Location of the earlier version: `path` in it, its tree `root`, and the new version's tree.

    With a `revision` the tree is a temporary copy, and locations in it are written as in git:
    `v1:sub/Laser.idsl`.
    """

    path: Path
    root: Path
    new_root: Path
    revision: str = ""

    def folders(self, paths: tuple[Path, ...]) -> tuple[Path, ...]:
        """Earlier versions of folders within the tree; other folders are the same for both."""
        return (*(self.old_path(item) or item for item in paths), _root(self.path))

    def old_path(self, item: Path) -> Path | None:
        """The earlier path of a file or folder; None outside the tree."""
        new, whole = self.new_root.resolve(), item.resolve()
        return self.root / whole.relative_to(new) if whole.is_relative_to(new) else None

    def with_names(self, item: Diagnostic) -> Diagnostic:
        """Findings with locations that the user can look up."""
        notes = tuple(n.replace(span=self._span(n.span)) if n.span else n for n in item.notes)
        return item.replace(span=self._span(item.span), notes=notes)

    def _span(self, span: Span) -> Span:
        if not self.revision or not span.source.path.is_relative_to(self.root):
            return span
        return Source(self.name(span.source.path), span.source.text).span(span.start, span.end)

    def name(self, path: Path) -> Path:
        """The displayed name of a file of the earlier version."""
        inside = path.relative_to(self.root) if self.revision else path
        return Path(f"{self.revision}:{inside}") if self.revision else path


def _report_unread(unread: Report, before: _EarlierVersion) -> None:
    """Report the files of the earlier version that have errors and are not compared."""
    paths = sorted({before.name(item.span.source.path) for item in unread})
    if paths:
        names = ", ".join(f"`{path}`" for path in paths[:5])
        more = f" and {len(paths) - 5} more" if len(paths) > 5 else ""
        message = f"{names}{more} had errors in the earlier version"
        options.print_error(f"{message}; what was not understood of it is not compared")


def _version(
    path: Path,
    folders: tuple[Path, ...],
    report: Report,
    not_compared: Collection[Path | None] | None = None,
) -> tuple[Version, list[Path]]:
    """All models at `path`, and the files with errors; `report` gets the errors only.

    `not_compared` are files to leave out; without it, those with errors are left out.
    """
    workspace = Workspace(folders)
    version, with_errors = Version(), []
    for file in _files(path, SUFFIXES):
        found = Report()
        model = check_file(file, workspace, found)
        if found.has_errors:
            with_errors.append(file)
        report.extend(d for d in found if d.severity is Severity.ERROR)
        if file not in not_compared if not_compared is not None else not found.has_errors:
            version.add(model)
    return version, with_errors


def _root(path: Path) -> Path:
    return path if path.is_dir() else path.parent


def _files(path: Path, suffixes: Collection[str]) -> list[Path]:
    if path.is_file():
        return [path] if path.suffix.lower() in suffixes else []
    return sorted(
        p
        for p in path.rglob("*")
        if p.suffix.lower() in suffixes and not SKIPPED_FOLDERS & set(p.relative_to(path).parts)
    )


@contextmanager
def _open_earlier_version(path: Path, against: str) -> Iterator[_EarlierVersion]:
    """The earlier version. Raises `VersionNotFound`."""
    where = path if path.is_dir() else path.parent
    folder = Path(against)
    if against and folder.is_dir():
        yield _EarlierVersion(folder if path.is_dir() else folder / path.name, folder, where)
        return
    if not against or against.startswith("-"):
        raise VersionNotFound(f"`{against}` is neither a git revision nor a folder")
    top = Path(_git(where, "rev-parse", "--show-toplevel").decode().strip())
    revision = _git(where, "rev-parse", "--verify", "--quiet", f"{against}^{{commit}}")
    data = _git(top, "archive", "--format=tar", revision.decode().strip())
    with tempfile.TemporaryDirectory() as temporary:
        root = Path(temporary).resolve()
        _unpack(data, root)
        inside = path.resolve().relative_to(top.resolve())
        yield _EarlierVersion(root / inside, root, top, against)


def _unpack(data: bytes, folder: Path) -> None:
    """The descriptions of an archive (Python 3.11.2 has no safe function to extract one)."""
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        for member in archive:
            content = archive.extractfile(member) if member.isfile() else None
            path = folder / member.name
            inside = path.resolve().is_relative_to(folder)
            if content and inside and path.suffix.lower() in ARCHIVED_SUFFIXES:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content.read())


def _git(where: Path, *arguments: str) -> bytes:
    try:
        run = subprocess.run(  # noqa: S603 - git, found as the user's shell finds it
            ["git", *arguments],  # noqa: S607
            cwd=where,
            capture_output=True,
            timeout=GIT_TIMEOUT_S,
            check=False,
        )
    except FileNotFoundError:
        raise VersionNotFound("git is not installed; give a folder to compare with") from None
    except subprocess.TimeoutExpired:
        raise VersionNotFound(f"`git {arguments[0]}` did not end within a minute") from None
    if run.returncode:
        message = run.stderr.decode("utf-8", "replace").strip()
        wrong = message or "there is neither such a git revision nor such a folder"
        raise VersionNotFound(f"cannot compare: {wrong}")
    return run.stdout
