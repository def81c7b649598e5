"""One old component folder to the files of a new one.

In: the folder, where the new one will be, the folders with interfaces. Out: a `Moved`: files as
data, and in the report everything that was not carried over. Nothing is written here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

from robocomp_dsl.check import check_cdsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.component_names import modules_of
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.config import Config, Entry, read_config, read_source
from robocomp_dsl.migrate.copies import copy_all, is_written
from robocomp_dsl.migrate.description import completed, modern, tree_of
from robocomp_dsl.migrate.folder import CONFIG_SUFFIXES, Fate, Found, files_of
from robocomp_dsl.migrate.ice import IceSettings, divide
from robocomp_dsl.migrate.infer import Parameters, infer
from robocomp_dsl.migrate.moved import Moved, MovedConfig
from robocomp_dsl.migrate.python import carried_over, period_in
from robocomp_dsl.migrate.texts import pdsl_text, yaml_text
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Module
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.source import Source, UnreadableSource

PERIOD = ("Period", "Compute")
"""Where configurations of the newer form have the period, in ms."""


def move_component(
    folder: Path,
    out: Path,
    folders: Sequence[Path],
    report: Report,
    elsewhere: Sequence[Path] = (),
) -> Moved | None:
    """The new component; None where there is no description to begin with, which is told.

    `elsewhere` are configurations of it that are not in its folder.
    """
    found = list(files_of(folder))
    path = _description(folder, found, report)
    workspace = Workspace((*folders, folder))
    if path is None:
        return None
    try:
        text = modern(path, workspace)
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_FILE, Source(path, "").whole, f"cannot read it: {error}")
        return None
    tree = tree_of(path, text)
    if tree is None:
        check_cdsl(path, workspace, report)
        report.add(codes.NO_DESCRIPTION, Source(path, text).whole, "it describes no component")
        return None
    if tree.parameters is not None:
        said = f"`{path.name}` has parameters already, so it is no component of RoboComp"
        report.add(codes.ALREADY_OURS, Source(path, text).whole, said)
        return None
    moved = Moved(folder, out, path.name, tree.name.text, Source(path, text).whole)
    given = list(_configs([*_own_configs(found), *elsewhere], report))
    divided = [(config, *divide(config, report)) for config in given]
    parameters = infer([(config, rest) for config, _, rest in divided], report)
    _describe(moved, path, text, parameters, _period(found, parameters, given, report))
    _configure(moved, divided, parameters)
    component = _resolve(moved, workspace, report)
    if component is not None:
        _carry_over(moved, component, found, parameters, report)
    copy_all(moved, found, report)
    return moved


def _description(folder: Path, found: Sequence[Found], report: Report) -> Path | None:
    """The one CDSL file of a folder; of several that which is called as the folder."""
    there = [f.path for f in found if f.fate is Fate.DESCRIPTION and f.path.suffix == ".cdsl"]
    named = [one for one in there if one.stem.lower() == folder.name.lower()]
    if len(there) == 1 or len(named) == 1:
        return (named or there)[0]
    said = f"`{folder}` has no CDSL file"
    if there:
        said = f"`{folder}` has several CDSL files: {', '.join(one.name for one in there)}"
    report.add(codes.NO_DESCRIPTION, Source(folder, "").whole, said)
    return None


def _own_configs(found: Sequence[Found]) -> list[Path]:
    """The configurations in the folder; the plain `config` is the first."""
    there = [one.path for one in found if one.fate is Fate.CONFIG]
    return sorted(there, key=lambda path: (path.stem != "config", path.name))


def _configs(paths: Sequence[Path], report: Report) -> Iterator[Config]:
    """All configurations that can be read."""
    for path in paths:
        try:
            config = read_config(read_source(path, report), report)
        except UnreadableSource as error:
            said = f"the configuration was not carried over: {error}"
            report.add(codes.UNREADABLE_FILE, Source(path, "").whole, said)
            continue
        if config is not None:
            yield config


def _period(
    found: Sequence[Found], parameters: Parameters, configs: Sequence[Config], report: Report
) -> int | None:
    """The period in ms, from the first configuration or from the worker."""
    for values in parameters.values[:1]:
        value = values.get(PERIOD)
        if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
            span = next(e.span for e in configs[0].entries if e.path == PERIOD)
            report.add(codes.PERIOD, span, f"the period of {value} ms is in the CDSL file")
            return value
    for one in found:
        if one.fate is Fate.WORKER and (given := period_in(one.path)) is not None:
            period, span = given
            report.add(codes.PERIOD, span, f"the period of {period} ms is in the CDSL file")
            return period
    return None


def _describe(
    moved: Moved, path: Path, text: str, parameters: Parameters, period: int | None
) -> None:
    pdsl = f"{path.stem}.pdsl" if parameters.tree else ""
    moved.add(OutputFile(path.name, completed(path, text, pdsl, period)), path.name)
    if pdsl:
        names = "the old configurations" if len(parameters.values) > 1 else "the old configuration"
        moved.add(OutputFile(pdsl, pdsl_text(moved.name, parameters.tree, names)), "etc/*")


def _configure(
    moved: Moved,
    divided: Sequence[tuple[Config, IceSettings, list[Entry]]],
    parameters: Parameters,
) -> None:
    made = []
    taken: set[str] = set()
    for (config, ice, _), values in zip(divided, parameters.values, strict=True):
        stem = config.path.stem if config.path.suffix in CONFIG_SUFFIXES else config.path.name
        stem = config.path.name.replace(".", "_") if stem in taken else stem
        while stem in taken:
            stem += "_"
        taken.add(stem)
        new, old = f"etc/{stem}.yaml", f"etc/{config.path.name}"
        text = yaml_text(moved.name, parameters.tree, values, old)
        moved.add(OutputFile(new, text), old)
        made.append(MovedConfig(config.path, new, ice))
    moved.configs = tuple(made)


def _resolve(moved: Moved, workspace: Workspace, report: Report) -> Component | None:
    """Check what will be written, as if it were there; bring the interfaces that it needs along.

    What the check finds is told when the files are there. The component is given with what could
    be understood of it; `moved` has it only if there are no errors.
    """
    for one in moved.files:
        workspace.files.open_buffer(moved.out / one.path, one.text)
    for path in (*moved.folder.glob("*.smdsl"), *moved.folder.glob("*.scxml")):
        with suppress(UnreadableSource):  # it is copied as it is, and judged there
            workspace.files.open_buffer(moved.out / path.name, workspace.files.read(path).text)
    found = Report()
    component = check_cdsl(moved.out / moved.description, workspace, found)
    if component is None or found.failed:
        said = f"`{moved.description}` has errors, so no code was generated"
        report.add(codes.BROKEN_DESCRIPTION, moved.span, said)
    else:
        moved.component = component
        for file in interface_files(modules_of(component), workspace):
            moved.add(file, file.path)
    for path in sorted(moved.folder.glob("*.idsl")):
        _bring(moved, path, workspace, report)
    return component


def _bring(moved: Moved, path: Path, workspace: Workspace, report: Report) -> None:
    try:
        moved.add(OutputFile(path.name, modern(path, workspace)), path.name)
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_FILE, Source(path, "").whole, f"cannot read it: {error}")


def interface_files(modules: Sequence[Module], workspace: Workspace) -> Iterator[OutputFile]:
    """Those of the IDSL files that do not come with the project, in today's form."""
    for one in modules:
        if not one.path.resolve().is_relative_to(INTERFACES.resolve()):
            yield OutputFile(one.path.name, modern(one.path, workspace))


def _carry_over(
    moved: Moved,
    component: Component,
    found: Sequence[Found],
    parameters: Parameters,
    report: Report,
) -> None:
    """The code in Python."""
    for file, old in carried_over(component, found, parameters, report):
        if is_written(file.path):
            source = Source(moved.folder / old, "")
            said = f"`{file.path}` is written by rcgen; the old file was not copied"
            report.add(codes.NOT_COPIED, source.whole, said)
        else:
            moved.add(file, old)
