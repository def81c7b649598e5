"""`rcgen component`: generates a component.

In: a CDSL file. Out: the files of its folder, written or only compared; findings on standard error.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import click

from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.missing_imports import lacks_imports_only
from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.plan import LANGUAGES, plan
from robocomp_dsl.generate.write import CannotWrite, Change, FileAction, compare, write
from robocomp_dsl.model.component import Component


class NearestChoice(click.ParamType[str]):
    """A case-insensitive choice; suggests the nearest name for an unknown one.

    `find` returns the canonical spelling, or None for an unknown name; `names` lists the names.
    """

    def __init__(
        self, what: str, find: Callable[[str], str | None], names: Callable[[], Sequence[str]]
    ) -> None:
        self.name = what
        self.find = find
        self.names = names

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The name in its canonical spelling. Fails for an unknown one."""
        found = self.find(value)
        if found is None:
            names = self.names()
            hint = did_you_mean(value, names) or f"it is one of {', '.join(names)}"
            self.fail(f"there is no {self.name} {value!r}; {hint}", param, ctx)
        return found


_MIDDLEWARES = KnownMiddlewares()


def _find_language(written: str) -> str | None:
    return written.lower() if written.lower() in LANGUAGES else None


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="X.cdsl")
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Output folder; default: the folder of the file.",
)
@click.option(
    "--middleware",
    type=NearestChoice("middleware", _MIDDLEWARES.find, _MIDDLEWARES.names),
    metavar="M",
    help="Override the middleware of the file, such as zenoh.",
)
@click.option(
    "--language",
    type=NearestChoice("target language", _find_language, lambda: tuple(LANGUAGES)),
    metavar="L",
    help=f"Override the language of the file: {', '.join(LANGUAGES)}.",
)
@options.write_modes
@options.output_format
@options.folders
def command(
    *,
    file: Path,
    output: Path | None,
    middleware: str | None,
    language: str | None,
    quiet: bool,
    output_format: str,
    folders: tuple[Path, ...],
    **modes: bool,
) -> None:
    """Generate a component from its CDSL file.

    `main.py` and `NAME_generated/` are rewritten each time; `specificworker.py`, `README.md` and
    `etc/config.yaml` are written once and then belong to you. Either all files are written or none.
    """
    mode = selected_mode(modes)
    report = Report()
    component = _component(file, language or "", Workspace(folders), report)
    chosen = {"language": language or "", "middleware": middleware or ""}
    files = plan(component, **chosen) if component else []
    folder = output or file.parent
    if component:
        files = _update_user_files(folder, component, files, report, writes=not mode)
    options.print_findings(report.sorted(), output_format, sys.stderr)
    if component is None:
        raise CliError(EXIT_FINDINGS)
    try:
        run_mode(mode, folder, files, quiet)
    except CannotWrite as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if report.has_errors:
        left_out = join_names([str(name) for name in component.invalid_ports]) or "what needs them"
        raise CliError(EXIT_FINDINGS, f"imports are missing: generated without {left_out}")


def selected_mode(modes: dict[str, bool]) -> str:
    """The requested one, or None."""
    asked = [name for name, on in modes.items() if on]
    if len(asked) > 1:
        names = " and ".join(f"--{name.replace('_', '-')}" for name in asked)
        raise click.UsageError(f"{names} exclude each other")
    return "".join(asked)


def _component(file: Path, language: str, workspace: Workspace, report: Report) -> Component | None:
    """The component of a file without errors, if its language has a target.

    Of missing imports only the ports are left out that need them.
    """
    found = check_cdsl(file, workspace, report)
    if found is None or (report.has_errors and not lacks_imports_only(report)):
        return None
    if (language or found.language).lower() in LANGUAGES:
        return found
    report.add(
        codes.NO_TARGET,
        found.language_span or found.span,
        f"there is no target for {found.language} yet",
        help="generate it for Python with `--language python`",
    )
    return None


def _update_user_files(
    folder: Path, component: Component, files: list[OutputFile], report: Report, *, writes: bool
) -> list[OutputFile]:
    """The files to write over the user's files."""
    from robocomp_dsl.generate.regeneration.update import update_user_files  # noqa: PLC0415 - only with a component

    return update_user_files(folder, component, files, report, writes=writes)


def run_mode(mode: str, folder: Path, files: list[OutputFile], quiet: bool) -> None:
    """Write or compare the files, as `mode` says. Raises `CliError` if --check finds changes."""
    if not mode:
        changes = write(folder, files)
        if not quiet:
            print(_summary(folder, changes))
        return
    changes = compare(folder, files)
    pending = [change for change in changes if change.pending and not change.file.is_internal]
    if mode == "diff":
        sys.stdout.write("".join(_diff(folder, change) for change in pending))
        return
    if mode == "dry_run":
        for change in changes:
            if not change.file.is_internal:
                print(f"{change.action:<10} {folder / change.file.path}")
        return
    for change in pending:
        state = "is missing" if change.old is None else "is out of date"
        state = "is no longer generated" if change.file.is_removed else state
        options.print_error(f"`{folder / change.file.path}` {state}")
    if pending:
        raise CliError(EXIT_FINDINGS)


def _summary(folder: Path, changes: list[Change]) -> str:
    """One line: how many files were written, and which write-once files are new."""
    removed = sum(change.action is FileAction.DELETE for change in changes)
    changes = [
        change for change in changes if not (change.file.is_internal or change.file.is_removed)
    ]
    written = sum(change.pending for change in changes)
    if not written and not removed:
        return f"{folder}: nothing to do, all {len(changes)} files are up to date"
    yours = [c.file.path for c in changes if c.file.write_once and c.action is FileAction.CREATE]
    begun = f"; yours to edit: {', '.join(yours)}" if yours else ""
    gone = f"; {removed} old files removed" if removed else ""
    return f"{folder}: {written} of {len(changes)} files written{gone}{begun}"


def _diff(folder: Path, change: Change) -> str:
    """The change as a unified diff, which `patch -p0` understands."""
    from difflib import unified_diff  # noqa: PLC0415 - only here

    path = str(folder / change.file.path)
    old = (change.old or b"").decode("utf-8", "replace").splitlines(keepends=True)
    new = change.file.text.splitlines(keepends=True)
    before = "/dev/null" if change.old is None else path
    after = "/dev/null" if change.file.is_removed else path
    lines = unified_diff(old, new, before, after)
    return "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines
    )
