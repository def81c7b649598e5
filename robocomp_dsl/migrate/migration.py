"""Plan the migration of RoboComp components and deployments. The old files are not changed.

In: folders of components, files of rcmanager. Out: a `MigrationPlan` with all files as data, and a
report. The stages, in order, one module each:

    component_files   list and classify the files of a folder
    description       CDSL in the current syntax
    config, ice       configurations as entries; the settings that only Ice reads
    infer             parameters from the entries of all configurations
    parameter_files   PDSL and YAML
    python_files      the worker and its modules; `worker` and `imports` adapt each,
                      `legacy` provides the old names
    copies            the other files
    component         all of these for one folder: a `MigratedComponent`
    manager           the processes of rcmanager or `sub.toml`
    deployment        addresses to `instances`; `connections` connects them, `ddsl` writes them
    yarp              files of yarpmanager and yarprobotinterface
    bottle_generator  configurations of yarp-bottle-generator
    migration_report  `MIGRATION.md`

Each stage reports errors in its input with file and line, and continues.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.python.component_names import modules_of
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.bottle_generator.convert import convert_file
from robocomp_dsl.migrate.component import interface_files, migrate_component
from robocomp_dsl.migrate.ddsl import PEERS, ddsl_text, interfaces_in, peer_files
from robocomp_dsl.migrate.deployment import candidate_names, draft_deployment, find_interface
from robocomp_dsl.migrate.instances import COMMON_BEHAVIOR, DeploymentDraft
from robocomp_dsl.migrate.manager import ManagerNode, read_manager
from robocomp_dsl.migrate.migrated_component import MigratedComponent
from robocomp_dsl.migrate.original_lines import locate_in_originals
from robocomp_dsl.migrate.yarp.migration import is_yarp_file, plan_yarp_files
from robocomp_dsl.model.interface import Module
from robocomp_dsl.source import Source, UnreadableSource

__all__ = ["MigrationPlan", "plan_migration"]


@dataclass(slots=True)
class MigrationPlan:
    """The files to write below the output folder.

    `components` are pairs of folder and component, `converted_files` pairs of old and new path;
    `worlds` are files from which simulators are generated, `bridges` files in BDSL.
    """

    name: str
    files: list[OutputFile] = field(default_factory=list)
    converted_files: list[tuple[str, str]] = field(default_factory=list)
    components: list[tuple[str, MigratedComponent]] = field(default_factory=list)
    deployments: list[str] = field(default_factory=list)
    worlds: list[str] = field(default_factory=list)
    bridges: list[str] = field(default_factory=list)


def plan_migration(
    inputs: Sequence[Path],
    out: Path,
    folders: Sequence[Path],
    report: Report,
    tags: Sequence[str] = (),
    topic_types: Mapping[str, str] | None = None,
) -> MigrationPlan:
    """Plan the migration of component folders, manager files and files of YARP.

    A single component folder is migrated to `out` itself, several to one folder each below it.
    `tags` enable optional parts of robots of YARP.
    `topic_types` are types of ROS topics, `package/Type`, for bridges.
    """
    files = [path for path in inputs if not path.is_dir()]
    yarp_files = [path for path in files if is_yarp_file(path)]
    configurations = [path for path in files if path.suffix.lower() == ".ini"]
    managers = [path for path in files if path not in (*yarp_files, *configurations)]
    sources = [path for path in inputs if path.is_dir()]
    alone = len(inputs) == 1 and bool(sources)
    plan = MigrationPlan("deployment")
    taken: set[str] = set()
    read = [(manager, _read_nodes(manager, report)) for manager in managers]
    for folder in sources:
        place = "" if alone else _unique_folder(folder, taken)
        moved = migrate_component(
            folder,
            out / place,
            folders,
            report,
            list(dict.fromkeys(_manager_configs(folder, read))),
        )
        if moved is not None:
            plan.components.append((place, moved))
            plan.name = moved.name
    nodes = [node for _, file_nodes in read for node in file_nodes]
    _add_deployment(plan, managers, nodes, out, folders, report)
    _add_yarp_files(plan, yarp_files, out, tags, report)
    _add_bridges(plan, configurations, folders, report, topic_types or {})
    for place, moved in plan.components:
        before = f"{place}/" if place else ""
        for file in moved.files:
            plan.files.append(_in_folder(before, file))
        shown = moved.folder.name if before else ""
        plan.converted_files += [
            (str(Path(shown, a)), before + b) for a, b in moved.converted_files
        ]
    locate_in_originals(report)
    return plan


def _add_yarp_files(
    plan: MigrationPlan, paths: Sequence[Path], out: Path, tags: Sequence[str], report: Report
) -> None:
    """Add the deployments of files of yarpmanager and yarprobotinterface."""
    if not paths:
        return
    taken = [deployment.removesuffix(".ddsl") for deployment in plan.deployments]
    yarp = plan_yarp_files(paths, out, report, tags=tags, taken=taken)
    plan.files += yarp.files
    plan.converted_files += yarp.converted_files
    plan.deployments += yarp.deployments
    plan.worlds += yarp.worlds
    if yarp.deployments and not plan.components:
        plan.name = yarp.deployments[0].removesuffix(".ddsl")


def _add_bridges(
    plan: MigrationPlan,
    paths: Sequence[Path],
    folders: Sequence[Path],
    report: Report,
    topic_types: Mapping[str, str],
) -> None:
    """Add the bridges of configurations of yarp-bottle-generator."""
    for path in paths:
        bridge = convert_file(path, Workspace(folders), report, topic_types)
        if bridge is None:
            continue
        name = f"{bridge.name}.bdsl"
        plan.files.append(OutputFile(name, bridge.formatted()))
        plan.converted_files.append((path.name, name))
        plan.bridges.append(name)
        plan.name = plan.name if plan.components or plan.deployments else bridge.name


def _manager_configs(
    folder: Path, read: Sequence[tuple[Path, list[ManagerNode]]]
) -> Iterator[Path]:
    """Configurations of a component that are stored in the folder of the manager's file."""
    name = folder.resolve().name
    for manager, nodes in read:
        for node in nodes:
            if node.config is None or name.lower() not in set().union(*candidate_names(node)):
                continue
            path = manager.parent / node.config.name
            usual = path.is_file() and not path.is_symlink()
            if usual and not (folder / "etc" / path.name).exists():
                yield path


def _unique_folder(folder: Path, taken: set[str]) -> str:
    """A folder name for a component that is not in `taken`; it is added there."""
    name = folder.resolve().name or "component"
    name = f"{name}_" if name == PEERS else name
    while name in taken:
        name += "_"
    taken.add(name)
    return name


def _in_folder(before: str, file: OutputFile) -> OutputFile:
    return OutputFile(before + file.path, file.text, encoding=file.encoding)


def _read_nodes(path: Path, report: Report) -> list[ManagerNode]:
    try:
        return read_manager(Source.read(path), report) or []
    except UnreadableSource as error:
        report.add(
            codes.UNREADABLE_FILE, Source(path, "").file_span, f"the file cannot be read: {error}"
        )
        return []


def _add_deployment(
    plan: MigrationPlan,
    managers: Sequence[Path],
    nodes: Sequence[ManagerNode],
    out: Path,
    folders: Sequence[Path],
    report: Report,
) -> None:
    """Add the deployment and the stand-ins for components that are known by address only."""
    components = [moved for _, moved in plan.components]
    if not nodes and not any(component.component for component in components):
        return
    draft = draft_deployment(components, nodes, report)
    workspace = Workspace((*folders, *(m.folder for m in components)))
    modules = _find_modules(draft, components, workspace, out)
    _find_stand_in_interfaces(draft, modules, report)
    first = managers[0].stem if managers else components[0].name
    plan.name = re.sub(r"^\d+|\W", "_", first, flags=re.ASCII) or "deployment"
    deployment = f"{plan.name}.ddsl"
    plan.deployments.append(deployment)
    source = managers[0].name if managers else "the addresses in etc/"
    doc = f"From {source.replace('*/', '* /')}: the components, their hosts and their connections."
    places = {id(moved): place for place, moved in plan.components}
    plan.files.append(OutputFile(deployment, ddsl_text(plan.name, draft, places, doc)))
    plan.converted_files.append((managers[0].name if managers else "etc/*", deployment))
    plan.files += peer_files(draft, modules)
    for instance in draft.instances:
        used = [modules[i.module] for i in instance.peer_interfaces if i.module in modules]
        closure = dict.fromkeys(m for module in used for m in module.closure())
        beside = f"{PEERS}/{instance.name}/"
        plan.files += [_in_folder(beside, f) for f in interface_files(list(closure), workspace)]


def _find_modules(
    draft: DeploymentDraft, components: Sequence[MigratedComponent], workspace: Workspace, out: Path
) -> dict[str, Module]:
    """Modules by name: those of the components, and all importable ones for stand-ins."""
    modules = {
        module.name: module
        for component in components
        if component.component
        for module in modules_of(component.component)
    }
    if not any(
        instance.migrated is None and not instance.peer_interfaces for instance in draft.instances
    ):
        return modules
    root = out / "x.cdsl"
    for name in workspace.import_resolver.importable_files(root):
        path = workspace.import_resolver.find(name, root)
        if path is None:
            continue
        workspace.modules.start_run(root)
        try:
            loaded = workspace.modules.load(path)
        except UnreadableSource:
            continue
        for module in loaded.modules:
            modules.setdefault(module.name, module)
    return modules


def _find_stand_in_interfaces(
    draft: DeploymentDraft, modules: dict[str, Module], report: Report
) -> None:
    """Set the interfaces of stand-ins for processes of the manager, where the address names one."""
    for instance in draft.instances:
        if instance.migrated is not None or instance.peer_interfaces:
            continue
        identity = next((a.identity for a in instance.endpoints if a.identity), "")
        interface = find_interface(identity, interfaces_in(modules))
        if interface is not None and not identity.lower().endswith(COMMON_BEHAVIOR):
            instance.peer_interfaces.append(interface)
        served = (
            f"serves {interface.name}"
            if instance.peer_interfaces and interface
            else "serves no known interface"
        )
        message = f"no folder was given for `{instance.name}`; its stand-in {served}"
        report.add(codes.STAND_IN, instance.span, message)
