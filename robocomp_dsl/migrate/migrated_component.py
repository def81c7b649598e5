"""A component during migration: its description and its files.

In: what `component` finds out. Out: `MigratedComponent`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate.ice import IceSettings
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Span


@dataclass(frozen=True, slots=True)
class MigratedConfig:
    """A configuration: the old file, the new one in the component's folder, and its addresses."""

    old: Path
    new: str
    ice: IceSettings


@dataclass(slots=True)
class MigratedComponent:
    """A component during migration. `component` is None if its description has errors.

    `has_window`: it has `gui`, so that files of Qt Designer are copied.
    """

    folder: Path
    out: Path
    description: str
    name: str
    span: Span
    component: Component | None = None
    has_window: bool = False
    configs: tuple[MigratedConfig, ...] = ()
    files: list[OutputFile] = field(default_factory=list)
    converted_files: list[tuple[str, str]] = field(default_factory=list)

    def add(self, file: OutputFile, old: str) -> None:
        """Add the file that replaces `old`, unless there is a file of the same path."""
        if all(existing.path != file.path for existing in self.files):
            self.files.append(file)
            self.converted_files.append((old, file.path))
