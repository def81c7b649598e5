"""`rcgen component`: generates a component.

In: a CDSL file. Out: the files of its folder, written or only compared; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from robocomp_dsl.check import check_cdsl
from robocomp_dsl.check.workspace import MIDDLEWARES, Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.generate import LANGUAGES, codes, plan
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import Action, CannotWrite, Change, compare, write
from robocomp_dsl.model.component import Component


class Known(click.ParamType[str]):
    """One of some names, whatever their case; the nearest is offered for another one."""

    def __init__(self, what: str, names: tuple[str, ...]) -> None:
        self.name = what
        self.names = names

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The name as it is spelled. Fails for an unknown one."""
        found = next((name for name in self.names if name.lower() == value.lower()), None)
        if found is None:
            hint = did_you_mean(value, self.names) or f"it is one of {', '.join(self.names)}"
            self.fail(f"there is no {self.name} {value!r}; {hint}", param, ctx)
        return found


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="X.cdsl")
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Write there instead of beside the file.",
)
@click.option(
    "--middleware",
    type=Known("middleware", MIDDLEWARES),
    metavar="M",
    help=f"Instead of the one in the file: {', '.join(MIDDLEWARES)}.",
)
@click.option(
    "--language",
    type=Known("target language", tuple(LANGUAGES)),
    metavar="L",
    help=f"Instead of the one in the file: {', '.join(LANGUAGES)}.",
)
@click.option("--check", is_flag=True, help="Write nothing; 1 if files are not as they would be.")
@click.option("--diff", is_flag=True, help="Write nothing; show what would change.")
@click.option("--dry-run", is_flag=True, help="Write nothing; list what would happen.")
@click.option("-q", "quiet", is_flag=True, help="Say nothing but findings.")
@options.output_format
@options.folders
def command(
    *,
    file: Path,
    output: Path | None,
    middleware: str | None,
    language: str | None,
    quiet: bool,
    form: str,
    folders: tuple[Path, ...],
    **modes: bool,
) -> None:
    """Generate a component from its CDSL file.

    `main.py` and `generated/` are rewritten; `specificworker.py`, `README.md` and `etc/config.yaml`
    are written once and then yours. All files are written, or none.
    """
    mode = _only(modes)
    report = Report()
    component = _component(file, language or "", Workspace(folders), report)
    chosen = {"language": language or "", "middleware": middleware or ""}
    files = plan(component, **chosen) if component else []
    folder = output or file.parent
    if component:
        files = _upkeep(folder, component, files, report, writes=not mode)
    options.show(report.sorted(), form, sys.stderr)
    if component is None:
        sys.exit(FINDINGS)
    try:
        sys.exit(_act(mode, folder, files, quiet))
    except CannotWrite as error:
        options.complain(str(error))
        sys.exit(FINDINGS)


def _only(modes: dict[str, bool]) -> str:
    """The one that was asked for, or nothing."""
    asked = [name for name, on in modes.items() if on]
    if len(asked) > 1:
        listed = " and ".join(f"--{name.replace('_', '-')}" for name in asked)
        raise click.UsageError(f"{listed} exclude each other")
    return "".join(asked)


def _component(file: Path, language: str, workspace: Workspace, report: Report) -> Component | None:
    """The component of a file without errors, if there is a target for its language."""
    found = check_cdsl(file, workspace, report)
    if found is None or report.failed:
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


def _upkeep(
    folder: Path, component: Component, files: list[OutputFile], report: Report, *, writes: bool
) -> list[OutputFile]:
    """The files as they are to be written over what the user made of them."""
    from robocomp_dsl.generate.upkeep import keep_up  # noqa: PLC0415 - only with a component

    return keep_up(folder, component, files, report, writes=writes)


def _act(mode: str, folder: Path, files: list[OutputFile], quiet: bool) -> int:
    """Do what `mode` says; the exit code."""
    if not mode:
        changes = write(folder, files)
        if not quiet:
            print(_told(folder, changes))
        return 0
    changes = compare(folder, files)
    pending = [one for one in changes if one.pending and not one.file.own]
    if mode == "diff":
        sys.stdout.write("".join(_diff(folder, one) for one in pending))
        return 0
    if mode == "dry_run":
        for one in changes:
            if not one.file.own:
                print(f"{one.action:<10} {folder / one.file.path}")
        return 0
    for one in pending:
        state = "is missing" if one.old is None else "is not what would be generated"
        options.complain(f"`{folder / one.file.path}` {state}")
    return FINDINGS if pending else 0


def _told(folder: Path, changes: list[Change]) -> str:
    """One line: how many files were written, and which of the user's are new."""
    changes = [one for one in changes if not one.file.own]
    written = sum(one.pending for one in changes)
    if not written:
        return f"{folder}: nothing to do, all {len(changes)} files are up to date"
    yours = [c.file.path for c in changes if c.file.keep and c.action is Action.CREATE]
    begun = f"; yours to edit: {', '.join(yours)}" if yours else ""
    return f"{folder}: {written} of {len(changes)} files written{begun}"


def _diff(folder: Path, change: Change) -> str:
    """The change as a unified diff, which `patch -p0` understands."""
    from difflib import unified_diff  # noqa: PLC0415 - only here

    path = str(folder / change.file.path)
    old = (change.old or b"").decode("utf-8", "replace").splitlines(keepends=True)
    new = change.file.text.splitlines(keepends=True)
    before = "/dev/null" if change.old is None else path
    lines = unified_diff(old, new, before, path)
    return "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines
    )
