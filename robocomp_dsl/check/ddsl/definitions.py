"""The definitions of groups that a deployment can use.

In: a DDSL file. Out: for it and for all DDSL files that it imports, the components and definitions
that are visible in it. A definition is a group outside of the deployment of its file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check.codes import groups as codes
from robocomp_dsl.check.ddsl.components import (
    CheckComponent,
    ImportedComponents,
    imported_components,
)
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.check.workspace.referenced_files import errors_of
from robocomp_dsl.check.workspace.source_cache import Parsed, canonical_path
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Node
from robocomp_dsl.syntax.parse import parse_ddsl

SUFFIX = ".ddsl"
MAX_INSTANCES = 1000
"""Instances of groups in one deployment."""
MAX_DEPTH = 50
"""Definitions that one instance may follow, directly and in each other."""


@dataclass(slots=True)
class DefinitionFile:
    """One DDSL file; `groups` are its own definitions, `visible` also those of its imports."""

    tree: ast.File
    components: ImportedComponents
    groups: dict[str, ast.Group] = field(default_factory=dict)
    visible: dict[str, ast.Group] = field(default_factory=dict)


class DefinitionFiles:
    """The DDSL files of one check; `files` are by canonical path, the checked one first."""

    def __init__(self, workspace: Workspace, check: CheckComponent) -> None:
        self.files: dict[str, DefinitionFile] = {}
        self._instances = 0
        self.is_exceeded = False
        self._by_source: dict[Path, DefinitionFile] = {}
        self._workspace = workspace
        self._check = check

    def file_of(self, node: Node) -> DefinitionFile:
        """The file in which a node is written."""
        return self._by_source[node.span.source.path]

    def components_of(self, node: Node) -> ImportedComponents:
        """The components that are visible where a node is written."""
        return self.file_of(node).components

    def load(self, file: Parsed[ast.File], report: Report) -> DefinitionFile:
        """Load a file and its imports; the errors of imported files are reported."""
        path = file.source.path
        components = imported_components(
            file.tree.imports, path, self._workspace, self._check, report
        )
        loaded = DefinitionFile(file.tree, components)
        self.files[canonical_path(path)] = loaded
        self._by_source[path] = loaded
        for group in file.tree.groups:
            earlier = loaded.groups.setdefault(group.name.text, group)
            if earlier is not group:
                report_duplicate(group.name, earlier.name, "group", report)
        loaded.visible.update(loaded.groups)
        self._load_imports(loaded, path, report)
        return loaded

    def _load_imports(self, file: DefinitionFile, path: Path, report: Report) -> None:
        for statement in file.tree.imports:
            target = path.parent / statement.path.value
            exists = self._workspace.sources.exists(target)
            if target.suffix.lower() != SUFFIX or not exists:
                continue  # `imported_components` reported a missing file
            imported = self._load_import(target, report)
            if imported is None:
                file.components.broken = True
                continue
            file.components.broken |= not imported.tree.complete
            if not imported.groups and imported.tree.complete:
                report.add(
                    codes.NO_DEFINITION,
                    statement.path.span,
                    f"`{target.name}` defines no group",
                    help=f"write `group arm {{ … }};` outside of the deployment of `{target.name}`",
                )
            for name, group in imported.groups.items():
                earlier = file.visible.setdefault(name, group)
                if earlier is not group:
                    report.add(
                        codes.SAME_DEFINITION,
                        statement.path.span,
                        f"there are two definitions of the group `{name}`",
                        notes=[
                            Note(earlier.name.span, "one is here"),
                            Note(group.name.span, "the other one is here"),
                        ],
                        help="rename one of them",
                    )

    def _load_import(self, path: Path, report: Report) -> DefinitionFile | None:
        known = self.files.get(canonical_path(path))
        if known is not None:
            return known
        try:
            parsed = self._workspace.sources.parse(path, parse_ddsl)
        except UnreadableSource:
            return None  # `imported_components` reported it
        file_report = Report()
        file_report.extend(parsed.diagnostics)
        loaded = self.load(parsed, file_report)
        report.extend(errors_of(file_report))
        return loaded

    def begin_deployment(self) -> None:
        """Count the instances of a deployment from here."""
        self._instances = 0
        self.is_exceeded = False

    def may_expand(self, group: ast.Group, depth: int, report: Report) -> bool:
        """Whether an instance in `depth` definitions is within the limits; reports the first."""
        self._instances += 1
        if self._instances <= MAX_INSTANCES and depth < MAX_DEPTH:
            return True
        if not self.is_exceeded:
            most = f"{MAX_INSTANCES} instances of groups"
            report.add(
                codes.TOO_LARGE,
                (group.definition or group.name).span,
                "this deployment has more than "
                + (most if depth < MAX_DEPTH else f"{MAX_DEPTH} definitions in each other"),
                help="remove instances from the definitions",
            )
        self.is_exceeded = True
        return False

    def find(self, group: ast.Group) -> ast.Group | None:
        """The definition of an instance; None if there is none of that name."""
        name = group.definition
        return self.file_of(group).visible.get(name.text) if name else None

    def report_unknown(
        self, group: ast.Group, siblings: Mapping[str, Node], report: Report
    ) -> None:
        """Report that an instance names no definition; `siblings` are groups beside it."""
        name = group.definition
        file = self.file_of(group)
        if name is None or file.components.broken:
            return
        message = f"there is no definition of a group `{name.text}`"
        if name.text in siblings:
            report.add(
                codes.UNKNOWN_DEFINITION,
                name.span,
                message,
                notes=[Note(siblings[name.text].span, f"`{name.text}` is a group of its own")],
                help="move it out of the `Deployment`: outside, a group is a definition",
            )
            return
        known = ", ".join(f"`{n}`" for n in file.visible)
        report_unknown_name(
            report,
            codes.UNKNOWN_DEFINITION,
            name,
            message,
            file.visible,
            f"known: {known}"
            if known
            else 'write `group NAME { … };` outside of the deployment, or `import "arm.ddsl";`',
            declared=[definition.name.span for definition in file.groups.values()],
        )
