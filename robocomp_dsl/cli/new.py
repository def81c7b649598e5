"""`rcgen new`: the first files of a component.

In: a name and ports. Out: CDSL, PDSL and IDSL files.
"""

from __future__ import annotations

import re
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax import ast_idsl, parse_idsl

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,99}")
ROLES = {
    "implements": "Serve this interface: its operations become methods that you write.",
    "requires": "Call this interface of another component.",
    "subscribes": "Hear this topic.",
    "publishes": "Fill this topic.",
}


class Name(click.ParamType[str]):
    """A name as the languages have it; it ends up in files and in their names."""

    name = "name"

    def convert(self, value: str, param: Any, ctx: Any) -> str:
        """`value` itself. Fails for what is no name."""
        if not NAME.fullmatch(value):
            said = f"{value!r} is no name: letters, digits and `_`, and no digit first"
            self.fail(said, param, ctx)
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
    help="Begin a new interface, too; it is implemented unless another option names it.",
)
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Where to; by default a new folder with the name of the component.",
)
@options.folders
def command(
    name: str, own: tuple[str, ...], output: Path | None, folders: tuple[Path, ...], **ports: Any
) -> None:
    """Begin a new component: a commented CDSL and PDSL file. Existing files are never changed."""
    folder = output or Path(name)
    wanted: dict[str, list[str]] = {role: list(dict.fromkeys(ports[role])) for role in ROLES}
    used = {x for names in wanted.values() for x in names}
    wanted["implements"] += [x for x in dict.fromkeys(own) if x not in used]
    imports = _imports(wanted, own, Workspace(folders), folder / f"{name}.cdsl")
    files = list(_files(name, wanted, dict.fromkeys(own), imports))
    sys.exit(_write(folder, files, name))


def _imports(
    wanted: dict[str, list[str]], own: tuple[str, ...], workspace: Workspace, root: Path
) -> list[str]:
    """The files to import for the ports. Raises `UsageError` for an unknown interface."""
    found = []
    for interface in dict.fromkeys(x for names in wanted.values() for x in names):
        path = None if interface in own else _declaring(interface, workspace, root)
        found.append(path.name if path else f"{interface}.idsl")
    return list(dict.fromkeys(found))


def _declaring(interface: str, workspace: Workspace, root: Path) -> Path:
    for path in workspace.search.mentioning(interface, root):
        if interface in _interfaces_of(path, workspace):
            return path
    files = (workspace.search.find(n, root) for n in workspace.search.known(root))
    guess = nearest(interface, (i for f in files if f for i in _interfaces_of(f, workspace)))
    hint = f"did you mean `{guess}`?" if guess else "add its folder with -I"
    raise click.UsageError(
        f"no file that can be imported declares the interface `{interface}`; {hint} "
        f"(`--interface {interface}` begins a new one)"
    )


def _interfaces_of(path: Path, workspace: Workspace) -> Iterator[str]:
    try:
        tree = workspace.files.parse(path, parse_idsl).tree
    except UnreadableSource:
        return
    for module in tree.modules:
        for one in module.declarations:
            if isinstance(one, ast_idsl.Interface):
                yield one.name.text


def _files(
    name: str, wanted: dict[str, list[str]], own: dict[str, None], imports: list[str]
) -> Iterator[OutputFile]:
    from robocomp_dsl.generate.templates import render  # noqa: PLC0415 - not for --help

    keywords = {"subscribes": "subscribesTo"}
    ports = [(keywords.get(r, r), ", ".join(names)) for r, names in wanted.items() if names]
    context = {"name": name, "imports": imports, "ports": ports}
    yield OutputFile(f"{name}.cdsl", render("new/component.cdsl.jinja", **context))
    yield OutputFile(f"{name}.pdsl", render("new/component.pdsl.jinja", name=name))
    topics = {*wanted["publishes"], *wanted["subscribes"]}
    for interface in own:
        served = interface not in topics
        text = render("new/interface.idsl.jinja", name=interface, served=served)
        yield OutputFile(f"{interface}.idsl", text)


def _write(folder: Path, files: list[OutputFile], name: str) -> int:
    from robocomp_dsl.generate.write import CannotWrite, compare, write  # noqa: PLC0415

    try:
        there = [one.file.path for one in compare(folder, files) if one.old is not None]
        if there:
            options.complain(f"`{folder / there[0]}` exists already; nothing was written")
            return FINDINGS
        write(folder, files)
    except CannotWrite as error:
        options.complain(str(error))
        return FINDINGS
    for one in files:
        print(f"wrote {folder / one.path}")
    print(f"next: edit them, then  rcgen component {shlex.quote(str(folder / name))}.cdsl")
    return 0
