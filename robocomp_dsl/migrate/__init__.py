"""Existing RoboComp components and deployments become ours; nothing of the old is changed.

In: folders of components, files of rcmanager. Out: a `Plan`: all files as data, and a report. The
stages, in order, each in a module of its own:

    folder        which files there are
    description   CDSL in today's form
    config, ice   configurations as entries; what of them only Ice reads
    infer, texts  entries of all files to parameters; PDSL and YAML
    python        the worker and its modules: `worker` and `imports` for each, `legacy` for names
    copies        the other files
    component     all of these for one folder, which gives a `moved` component
    manager       the processes of rcmanager or `sub.toml`
    deployment    addresses to `instances`, with `wiring`; `ddsl` writes them
    record        `MIGRATION.md`

Each goes on after a mistake in what it reads, which it reports with file and line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.component_names import modules_of
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.component import interface_files, move_component
from robocomp_dsl.migrate.ddsl import PEERS, ddsl_text, interfaces_in, peer_files
from robocomp_dsl.migrate.deployment import by_identity, called, draft
from robocomp_dsl.migrate.instances import COMMON, Draft
from robocomp_dsl.migrate.manager import Node, read_manager
from robocomp_dsl.migrate.moved import Moved
from robocomp_dsl.model.interface import Module
from robocomp_dsl.source import Source, UnreadableSource

__all__ = ["Plan", "move_over"]


@dataclass(slots=True)
class Plan:
    """What is to be written below the output folder; `places` are the folders of components."""

    name: str
    files: list[OutputFile] = field(default_factory=list)
    became: list[tuple[str, str]] = field(default_factory=list)
    components: list[tuple[str, Moved]] = field(default_factory=list)
    deployment: str = ""


def move_over(inputs: Sequence[Path], out: Path, folders: Sequence[Path], report: Report) -> Plan:
    """The plan for some component folders and manager files; one folder alone goes to `out`."""
    managers = [one for one in inputs if not one.is_dir()]
    given = [one for one in inputs if one.is_dir()]
    alone = len(inputs) == 1 and bool(given)
    plan = Plan("deployment")
    taken: set[str] = set()
    read = [(one, _nodes(one, report)) for one in managers]
    for one in given:
        place = "" if alone else _place(one, taken)
        moved = move_component(
            one, out / place, folders, report, list(dict.fromkeys(_beside(one, read)))
        )
        if moved is not None:
            plan.components.append((place, moved))
            plan.name = moved.name
    nodes = [node for _, found in read for node in found]
    _deploy(plan, managers, nodes, out, folders, report)
    for place, moved in plan.components:
        before = f"{place}/" if place else ""
        for file in moved.files:
            plan.files.append(_below(before, file))
        shown = moved.folder.name if before else ""
        plan.became += [(str(Path(shown, a)), before + b) for a, b in moved.became]
    return plan


def _beside(folder: Path, read: Sequence[tuple[Path, list[Node]]]) -> Iterator[Path]:
    """Configurations of a component that lie beside the manager's file, as those of a robot do."""
    name = folder.resolve().name
    for manager, nodes in read:
        for node in nodes:
            if node.config is None or name.lower() not in set().union(*called(node)):
                continue
            path = manager.parent / node.config.name
            usual = path.is_file() and not path.is_symlink()
            if usual and not (folder / "etc" / path.name).exists():
                yield path


def _place(folder: Path, taken: set[str]) -> str:
    """The folder of a component, none twice."""
    name = folder.resolve().name or "component"
    name = f"{name}_" if name == PEERS else name
    while name in taken:
        name += "_"
    taken.add(name)
    return name


def _below(before: str, file: OutputFile) -> OutputFile:
    return OutputFile(before + file.path, file.text, encoding=file.encoding)


def _nodes(path: Path, report: Report) -> list[Node]:
    try:
        return read_manager(Source.read(path), report) or []
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_FILE, Source(path, "").whole, f"cannot read it: {error}")
        return []


def _deploy(
    plan: Plan,
    managers: Sequence[Path],
    nodes: Sequence[Node],
    out: Path,
    folders: Sequence[Path],
    report: Report,
) -> None:
    """Add the deployment and its stand-ins."""
    components = [moved for _, moved in plan.components]
    if not nodes and not any(one.component for one in components):
        return
    made = draft(components, nodes, report)
    workspace = Workspace((*folders, *(m.folder for m in components)))
    modules = _modules(made, components, workspace, out)
    _fill_stand_ins(made, modules, report)
    first = managers[0].stem if managers else components[0].name
    plan.name = re.sub(r"^\d+|\W", "_", first, flags=re.ASCII) or "deployment"
    plan.deployment = f"{plan.name}.ddsl"
    source = managers[0].name if managers else "the addresses in etc/"
    doc = f"From {source.replace('*/', '* /')}: who runs where, and who calls whom."
    places = {id(moved): place for place, moved in plan.components}
    plan.files.append(OutputFile(plan.deployment, ddsl_text(plan.name, made, places, doc)))
    plan.became.append((managers[0].name if managers else "etc/*", plan.deployment))
    plan.files += peer_files(made, modules)
    for one in made.instances:
        used = [modules[i.module] for i in one.peer if i.module in modules]
        closure = dict.fromkeys(m for module in used for m in module.closure())
        beside = f"{PEERS}/{one.name}/"
        plan.files += [_below(beside, f) for f in interface_files(list(closure), workspace)]


def _modules(
    made: Draft, components: Sequence[Moved], workspace: Workspace, out: Path
) -> dict[str, Module]:
    """Modules by name: those of the components; all that can be imported if a stand-in needs it."""
    found = {
        module.name: module
        for one in components
        if one.component
        for module in modules_of(one.component)
    }
    if not any(one.moved is None and not one.peer for one in made.instances):
        return found
    root = out / "x.cdsl"
    for name in workspace.search.known(root):
        path = workspace.search.find(name, root)
        if path is None:
            continue
        workspace.library.begin(root)
        try:
            loaded = workspace.library.load(path)
        except UnreadableSource:
            continue
        for module in loaded.modules:
            found.setdefault(module.name, module)
    return found


def _fill_stand_ins(made: Draft, modules: dict[str, Module], report: Report) -> None:
    """What a process of the manager serves, as far as its address says it."""
    for one in made.instances:
        if one.moved is not None or one.peer:
            continue
        identity = next((a.identity for a in one.listens if a.identity), "")
        found = by_identity(identity, interfaces_in(modules))
        if found is not None and not identity.lower().endswith(COMMON):
            one.peer.append(found)
        served = f"serves {found.name}" if one.peer and found else "serves nothing that is known"
        said = f"`{one.name}` is not among the folders; its stand-in {served}"
        report.add(codes.STAND_IN, one.span, said)
