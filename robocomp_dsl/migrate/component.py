"""Migrate one component folder to the files of a new component.

In: the folder, the output folder, the folders with interfaces. Out: a `MigratedComponent` with
files as data; everything that was not migrated is reported. Nothing is written to disk here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

from robocomp_dsl.check.missing_imports import lacks_imports_only
from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.python.component_names import modules_of
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.component_files import (
    CONFIG_SUFFIXES,
    ComponentFile,
    FileCategory,
    list_files,
)
from robocomp_dsl.migrate.config import Config, ConfigEntry, read_config, read_source
from robocomp_dsl.migrate.copies import copy_all, is_generated_file
from robocomp_dsl.migrate.description import complete_description, parse_component, upgrade_syntax
from robocomp_dsl.migrate.ice import IceSettings, split_ice_settings
from robocomp_dsl.migrate.infer import InferredParameters, infer
from robocomp_dsl.migrate.migrated_component import MigratedComponent, MigratedConfig
from robocomp_dsl.migrate.parameter_files import pdsl_text, yaml_text
from robocomp_dsl.migrate.python_files import find_period, migrate_python_files
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Module
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.source import Source, UnreadableSource

PERIOD_KEY = ("Period", "Compute")
"""The key of the period [ms] in TOML configurations."""


def migrate_component(
    folder: Path,
    out: Path,
    folders: Sequence[Path],
    report: Report,
    extra_configs: Sequence[Path] = (),
) -> MigratedComponent | None:
    """The new component; None, with a finding, if the folder has no usable description.

    `extra_configs` are configurations of the component that are not in its folder.
    """
    files = list(list_files(folder))
    path = _find_description(folder, files, report)
    workspace = Workspace((*folders, folder))
    if path is None:
        return None
    try:
        text = upgrade_syntax(path, workspace)
    except UnreadableSource as error:
        report.add(
            codes.UNREADABLE_FILE, Source(path, "").file_span, f"the file cannot be read: {error}"
        )
        return None
    tree = parse_component(path, text)
    if tree is None:
        check_cdsl(path, workspace, report)
        report.add(
            codes.NO_DESCRIPTION, Source(path, text).file_span, "the file describes no component"
        )
        return None
    if tree.parameters is not None:
        message = f"`{path.name}` names a PDSL file, so the component is already migrated"
        report.add(codes.ALREADY_MIGRATED, Source(path, text).file_span, message)
        return None
    moved = MigratedComponent(folder, out, path.name, tree.name.text, Source(path, text).file_span)
    moved.has_window = tree.gui is not None
    configs = list(_read_configs([*_config_paths(files), *extra_configs], report))
    divided = [(config, *split_ice_settings(config, report)) for config in configs]
    parameters = infer([(config, rest) for config, _, rest in divided], report)
    _add_description(
        moved, path, text, parameters, _find_period(files, parameters, configs, report)
    )
    _add_configs(moved, divided, parameters)
    component = _check_result(moved, workspace, report)
    if component is not None:
        _add_python_files(moved, component, files, parameters, report)
    copy_all(moved, files, report)
    return moved


def _find_description(folder: Path, files: Sequence[ComponentFile], report: Report) -> Path | None:
    """The only CDSL file of a folder; of several, the one that is named like the folder."""
    candidates = [
        f.path for f in files if f.category is FileCategory.DESCRIPTION and f.path.suffix == ".cdsl"
    ]
    named = [path for path in candidates if path.stem.lower() == folder.name.lower()]
    if len(candidates) == 1 or len(named) == 1:
        return (named or candidates)[0]
    message = f"`{folder}` has no CDSL file"
    if candidates:
        names = ", ".join(path.name for path in candidates)
        message = f"`{folder}` has several CDSL files: {names}"
    report.add(codes.NO_DESCRIPTION, Source(folder, "").file_span, message)
    return None


def _config_paths(files: Sequence[ComponentFile]) -> list[Path]:
    """The configurations in the folder; the one named `config` comes first."""
    paths = [file.path for file in files if file.category is FileCategory.CONFIG]
    return sorted(paths, key=lambda path: (path.stem != "config", path.name))


def _read_configs(paths: Sequence[Path], report: Report) -> Iterator[Config]:
    """All configurations that can be read."""
    for path in paths:
        try:
            config = read_config(read_source(path, report), report)
        except UnreadableSource as error:
            message = f"the configuration was not migrated: {error}"
            report.add(codes.UNREADABLE_FILE, Source(path, "").file_span, message)
            continue
        if config is not None:
            yield config


def _find_period(
    files: Sequence[ComponentFile],
    parameters: InferredParameters,
    configs: Sequence[Config],
    report: Report,
) -> int | None:
    """The period [ms], from the first configuration or from the worker."""
    for values in parameters.values[:1]:
        value = values.get(PERIOD_KEY)
        if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
            span = next(e.span for e in configs[0].entries if e.path == PERIOD_KEY)
            report.add(
                codes.PERIOD_MIGRATED, span, f"the period of {value} ms was moved to the CDSL file"
            )
            return value
    for file in files:
        if (
            file.category is FileCategory.WORKER
            and (assignment := find_period(file.path)) is not None
        ):
            period, span = assignment
            report.add(
                codes.PERIOD_MIGRATED, span, f"the period of {period} ms was moved to the CDSL file"
            )
            return period
    return None


def _add_description(
    moved: MigratedComponent,
    path: Path,
    text: str,
    parameters: InferredParameters,
    period: int | None,
) -> None:
    pdsl = f"{path.stem}.pdsl" if parameters.tree else ""
    moved.add(OutputFile(path.name, complete_description(path, text, pdsl, period)), path.name)
    if pdsl:
        names = "the old configurations" if len(parameters.values) > 1 else "the old configuration"
        moved.add(OutputFile(pdsl, pdsl_text(moved.name, parameters.tree, names)), "etc/*")


def _add_configs(
    moved: MigratedComponent,
    divided: Sequence[tuple[Config, IceSettings, list[ConfigEntry]]],
    parameters: InferredParameters,
) -> None:
    migrated = []
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
        migrated.append(MigratedConfig(config.path, new, ice))
    moved.configs = tuple(migrated)


def _check_result(
    moved: MigratedComponent, workspace: Workspace, report: Report
) -> Component | None:
    """Check the new files before they are written; add the interfaces that they import.

    The findings of this check are not reported here but after the files are written. The component
    is returned even if it is incomplete; `moved` gets it only if there are no errors but missing
    imports, whose ports are left out.
    """
    for file in moved.files:
        workspace.sources.set_overlay(moved.out / file.path, file.text)
    for path in (*moved.folder.glob("*.smdsl"), *moved.folder.glob("*.scxml")):
        with suppress(UnreadableSource):  # the file is copied unchanged and checked later
            workspace.sources.set_overlay(moved.out / path.name, workspace.sources.read(path).text)
    check_report = Report()
    component = check_cdsl(moved.out / moved.description, workspace, check_report)
    is_partial = lacks_imports_only(check_report)
    if component is None or (check_report.has_errors and not is_partial):
        message = f"`{moved.description}` has errors, so no code was generated"
        report.add(codes.BROKEN_DESCRIPTION, moved.span, message)
    else:
        moved.component = component
        for file in interface_files(modules_of(component), workspace):
            moved.add(file, file.path)
    for path in sorted(moved.folder.glob("*.idsl")):
        _add_interface_file(moved, path, workspace, report)
    return component


def _add_interface_file(
    moved: MigratedComponent, path: Path, workspace: Workspace, report: Report
) -> None:
    try:
        moved.add(OutputFile(path.name, upgrade_syntax(path, workspace)), path.name)
    except UnreadableSource as error:
        report.add(
            codes.UNREADABLE_FILE, Source(path, "").file_span, f"the file cannot be read: {error}"
        )


def interface_files(modules: Sequence[Module], workspace: Workspace) -> Iterator[OutputFile]:
    """The IDSL files that are not part of the interface library, in the current syntax."""
    for module in modules:
        if not module.path.resolve().is_relative_to(INTERFACES.resolve()):
            yield OutputFile(module.path.name, upgrade_syntax(module.path, workspace))


def _add_python_files(
    moved: MigratedComponent,
    component: Component,
    files: Sequence[ComponentFile],
    parameters: InferredParameters,
    report: Report,
) -> None:
    """Add the Python files of the component."""
    for file, old in migrate_python_files(component, files, parameters, report):
        if is_generated_file(file.path):
            source = Source(moved.folder / old, "")
            message = f"`{file.path}` is generated by rcgen; the old file was not copied"
            report.add(codes.NOT_COPIED, source.file_span, message)
        else:
            moved.add(file, old)
