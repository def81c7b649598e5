"""`rcgen new`: the first files of a component, or a copy of an example.

In: a name, and ports or the name of an example. Out: new files.
"""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import did_you_mean, nearest
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast import idsl
from robocomp_dsl.syntax.parse import parse_idsl

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,99}")
ROLES = {
    "implements": "Serve this interface: its operations become methods that you write.",
    "requires": "Call this interface of another component.",
    "subscribes": "Subscribe to this topic.",
    "publishes": "Fill this topic.",
}


class Name(click.ParamType[str]):
    """A valid identifier of the languages; it is used in files and file names."""

    name = "name"

    def convert(self, value: str, param: Any, ctx: Any) -> str:
        """`value` itself. Fails for an invalid name."""
        if not NAME.fullmatch(value):
            message = (
                f"{value!r} is not a valid name: "
                "use letters, digits and `_`, not starting with a digit"
            )
            self.fail(message, param, ctx)
        return value


def _ports(command: options.Command) -> options.Command:
    for role, about in reversed(ROLES.items()):
        option = click.option(f"--{role}", multiple=True, type=Name(), metavar="X", help=about)
        command = option(command)
    return command


@click.command()
@click.argument("name", type=Name())
@_ports
@click.option(
    "--interface",
    "own",
    multiple=True,
    type=Name(),
    metavar="X",
    help="Also create an interface; it is implemented unless another option names it.",
)
@click.option(
    "--example",
    type=Name(),
    metavar="X",
    help="Copy this example instead, with all that it needs; `rcgen examples` lists them.",
)
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Output folder; default: a new folder NAME.",
)
@options.folders
def command(
    name: str,
    own: tuple[str, ...],
    example: str | None,
    output: Path | None,
    folders: tuple[Path, ...],
    **ports: Any,
) -> None:
    """Start a new component: a commented CDSL and PDSL file. Existing files are never changed.

    With `--example` a new folder gets a copy of an example that is ready to run.
    """
    folder = output or Path(name)
    if example:
        if own or any(ports.values()):
            raise click.UsageError("--example copies a component with its ports: give no others")
        _copy(folder, example)
        return
    interfaces: dict[str, list[str]] = {role: list(dict.fromkeys(ports[role])) for role in ROLES}
    used = {x for names in interfaces.values() for x in names}
    interfaces["implements"] += [x for x in dict.fromkeys(own) if x not in used]
    imports = _imports(interfaces, own, Workspace(folders), folder / f"{name}.cdsl")
    files = list(_files(name, interfaces, dict.fromkeys(own), imports))
    _write(folder, files, name)


def _imports(
    interfaces: dict[str, list[str]], own: tuple[str, ...], workspace: Workspace, root: Path
) -> list[str]:
    """The files to import for the ports. Raises `UsageError` for an unknown interface."""
    found = []
    for interface in dict.fromkeys(x for names in interfaces.values() for x in names):
        path = None if interface in own else _find_declaring_file(interface, workspace, root)
        found.append(_import_text(path, root) if path else f"{interface}.idsl")
    return list(dict.fromkeys(found))


def _import_text(path: Path, root: Path) -> str:
    """What to import for the file `path` in the new file `root`: its name, if that is enough.

    Without `-I`, as the next commands may be given and as an editor works.
    """
    found = Workspace().import_resolver.find(path.name, root)
    if found is not None and found.resolve() == path.resolve():
        return path.name
    try:
        return Path(os.path.relpath(path.resolve(), root.parent.resolve())).as_posix()
    except ValueError:  # on another drive
        return path.resolve().as_posix()


def _find_declaring_file(interface: str, workspace: Workspace, root: Path) -> Path:
    for path in workspace.import_resolver.files_mentioning(interface, root):
        if interface in _interfaces_of(path, workspace):
            return path
    files = (
        workspace.import_resolver.find(n, root)
        for n in workspace.import_resolver.importable_files(root)
    )
    guess = nearest(interface, (i for f in files if f for i in _interfaces_of(f, workspace)))
    hint = f"did you mean `{guess}`?" if guess else "add its folder with -I"
    raise click.UsageError(
        f"no file that can be imported declares the interface `{interface}`; {hint} "
        f"(`--interface {interface}` begins a new one)"
    )


def _interfaces_of(path: Path, workspace: Workspace) -> Iterator[str]:
    try:
        tree = workspace.sources.parse(path, parse_idsl).tree
    except UnreadableSource:
        return
    for module in tree.modules:
        for declaration in module.declarations:
            if isinstance(declaration, idsl.Interface):
                yield declaration.name.text


def _files(
    name: str, interfaces: dict[str, list[str]], own: dict[str, None], imports: list[str]
) -> Iterator[OutputFile]:
    from robocomp_dsl.generate.templates import render  # noqa: PLC0415 - not for --help

    keywords = {"subscribes": "subscribesTo"}
    ports = [(keywords.get(r, r), ", ".join(names)) for r, names in interfaces.items() if names]
    context = {"name": name, "imports": imports, "ports": ports}
    yield OutputFile(f"{name}.cdsl", render("new/component.cdsl.jinja", **context))
    yield OutputFile(f"{name}.pdsl", render("new/component.pdsl.jinja", name=name))
    topics = {*interfaces["publishes"], *interfaces["subscribes"]}
    for interface in own:
        served = interface not in topics
        text = render("new/interface.idsl.jinja", name=interface, served=served)
        yield OutputFile(f"{interface}.idsl", text)


def _write(folder: Path, files: list[OutputFile], name: str) -> None:
    _create(folder, files)
    for file in files:
        print(f"wrote {folder / file.path}")
    print(f"next: edit them, then  rcgen component {shlex.quote(str(folder / name))}.cdsl")


def _copy(folder: Path, name: str) -> None:
    """Copy the example called `name`. Raises `UsageError` for an unknown one."""
    from robocomp_dsl.cli.rcgen.shipped import example_files, examples  # noqa: PLC0415 - seldom

    known = examples()
    example = known.get(name)
    if example is None:
        guess = did_you_mean(name, known) or "`rcgen examples` lists them"
        raise click.UsageError(f"there is no example `{name}`; {guess}")
    if folder.is_dir() and any(folder.iterdir()):
        raise CliError(
            EXIT_FINDINGS, f"the folder `{folder}` is not empty; choose another name, or use -o DIR"
        )
    files = example_files(example)
    _create(folder, files)
    place = folder / "components" / example.folder.name
    print(f"{folder}: {len(files)} files written")
    print(f"next: cd {shlex.quote(str(place))} && {example.start}")


def _create(folder: Path, files: list[OutputFile]) -> None:
    """Write new files, all or none. Raises `CliError` if one exists or cannot be written."""
    from robocomp_dsl.generate.write import CannotWrite, compare, write  # noqa: PLC0415

    try:
        existing = [change.file.path for change in compare(folder, files) if change.old is not None]
        if existing:
            raise CliError(
                EXIT_FINDINGS, f"`{folder / existing[0]}` exists already; nothing was written"
            )
        write(folder, files)
    except CannotWrite as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
