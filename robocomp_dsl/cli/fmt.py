"""`rcgen fmt`: formats files. In: files and folders. Out: the same, as the house writes them."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import click

from robocomp_dsl.check import check_syntax
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.given import descriptions
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.cli.rewriting import BOM, difference, rewrite
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.format import PARSERS, CannotFormat, formatted
from robocomp_dsl.generate.write import CannotWrite
from robocomp_dsl.source import Source, UnreadableSource, declared_as_utf8, decode

STDIN = Path("-")


@click.command()
@options.files
@click.option("--check", "checking", is_flag=True, help="Write nothing; list what would change.")
@click.option("--diff", is_flag=True, help="Write nothing; show what would change.")
@click.option(
    "--stdin-filename",
    "name",
    type=click.Path(readable=False, path_type=Path),
    metavar="NAME",
    help="With `-`: how the text would be called; tells its language.",
)
@click.option("-q", "quiet", is_flag=True, help="No summary.")
def command(
    *, files: tuple[Path, ...], checking: bool, diff: bool, name: Path | None, quiet: bool
) -> None:
    """Format descriptions in place, of a folder all that are in it but XML; `-` is standard input.

    A file with errors of form is left alone and its errors are shown. The exit code is 1 if there
    was one, and with --check also if a file would change.
    """
    if (STDIN in files) != (name is not None) or (STDIN in files and len(files) > 1):
        raise click.UsageError("`-` stands alone and needs --stdin-filename, as in `x.cdsl`")
    run = _Run()
    if name:
        run.take_stdin(name)
    else:
        found = descriptions(files)
        run.take([one for one in found if one in files or one.suffix.lower() in PARSERS])
    if diff:
        run.show_differences()
    elif checking:
        run.list_changes(quiet)
    elif name:
        run.print_stdin(name)
    else:
        run.write(quiet)
    sys.stdout.flush()
    options.show(run.report.sorted(), "full", sys.stderr)
    failed = run.failed or run.report.failed
    sys.exit(FINDINGS if failed or (checking and run.changing) else 0)


class _Run:
    """The texts of one run: `new` holds what each shall be, if that is known."""

    def __init__(self) -> None:
        self.report = Report()
        self.failed = False
        self.new: dict[Path, str] = {}
        self.old: dict[Path, str] = {}
        self._workspace = Workspace(())
        self._mark = ""

    @property
    def changing(self) -> list[Path]:
        return [path for path, text in self.new.items() if text != self.old[path]]

    def take(self, paths: Sequence[Path]) -> None:
        for path in paths:
            self._take(path)

    def take_stdin(self, name: Path) -> None:
        data = sys.stdin.buffer.read()
        try:
            text = decode(data)
        except UnreadableSource as error:
            self._fail(f"standard input cannot be read: {error}")
            return
        self._mark = BOM if data.startswith(BOM.encode()) else ""
        self._workspace.files.open_buffer(name, text)
        self._take(name)

    def _take(self, path: Path) -> None:
        found = Report()
        check_syntax(path, self._workspace, found)
        if found.failed:
            self.report.extend(one for one in found if one.severity is Severity.ERROR)
            return
        if path.suffix.lower() not in PARSERS:
            self._fail(f"`{path}` stays as it is: its language has no format of ours")
            return
        source: Source = self._workspace.files.read(path)
        try:
            new = formatted(source, list(found))
        except CannotFormat as error:
            self._fail(f"`{path}` stays as it is: {error}")
            return
        if new is not None:
            self.old[path], self.new[path] = source.text, new

    def show_differences(self) -> None:
        for path in self.changing:
            sys.stdout.write(difference(path, self.old[path], self.new[path]))

    def list_changes(self, quiet: bool) -> None:
        for path in self.changing:
            print(path)
        self._sum_up("would be formatted", quiet)

    def print_stdin(self, name: Path) -> None:
        text = self._mark + declared_as_utf8(self.new.get(name, ""))
        sys.stdout.buffer.write(text.encode())

    def write(self, quiet: bool) -> None:
        for path in self.changing:
            try:
                rewrite(path, self.new[path])
            except CannotWrite as error:
                self._fail(str(error))
                del self.new[path]
        self._sum_up("formatted", quiet)

    def _fail(self, said: str) -> None:
        options.complain(said)
        self.failed = True

    def _sum_up(self, what: str, quiet: bool) -> None:
        if quiet:
            return
        changed = len(self.changing)
        left = len(self.new) - changed
        parts = [f"{_files(changed)} {what}"] if changed or not left else []
        parts += [f"{_files(left)} unchanged"] if left else []
        print(", ".join(parts), file=sys.stderr)


def _files(count: int) -> str:
    return f"{count} file{'s' if count != 1 else ''}"
