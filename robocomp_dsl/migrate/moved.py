"""A component on its way: what is known of it, and its files.

In: what `component` finds out. Out: `Moved`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate.ice import IceSettings
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Span


@dataclass(frozen=True, slots=True)
class MovedConfig:
    """A configuration: the old file, the new one in the component's folder, and its addresses."""

    old: Path
    new: str
    ice: IceSettings


@dataclass(slots=True)
class Moved:
    """A component on its way. `component` is None where its description has errors."""

    folder: Path
    out: Path
    description: str
    name: str
    span: Span
    component: Component | None = None
    configs: tuple[MovedConfig, ...] = ()
    files: list[OutputFile] = field(default_factory=list)
    became: list[tuple[str, str]] = field(default_factory=list)

    def add(self, file: OutputFile, old: str) -> None:
        """A file that `old` became; the first of a path stays."""
        if all(one.path != file.path for one in self.files):
            self.files.append(file)
            self.became.append((old, file.path))
