"""Paths in `set` lines: relative to the file in which they are written.

In: the value of a parameter of the type `path`. Out: the absolute path, and a diagnostic if there
is no such file or folder. A file that only the component finds, beside its configuration or in the
search paths of configurations, keeps its path.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.syntax.ast.base import Node
from robocomp_dsl.syntax.ast.ddsl import Setting

_CONFIGURATION = Path("etc", "config.yaml")


@dataclass(frozen=True, slots=True)
class PathSearch:
    """`folder` is that of the component, where it runs; `config` is its configuration, if set.

    `is_local`: it runs on this machine, so absolute paths can be looked up.
    """

    folder: Path
    config: Path | None
    is_local: bool

    def find(self, value: str, setting: Setting, written: Node, report: Report) -> Path | None:
        """The absolute path of `value`, which is `written` in `setting`, relative to its file.

        None for an absolute path, for one that only the component finds, and, with a diagnostic,
        for one that does not exist.
        """
        absolute = Path(value).expanduser()
        if absolute.is_absolute():
            if self.is_local and not _exists(absolute):
                _report_missing(value, absolute, setting, written, report)
            return None
        beside = setting.value.span.source.path
        path = beside.parent / value
        if _exists(path):
            return Path(os.path.abspath(path))  # noqa: PTH100 - keeps symbolic links
        if not self._component_finds(value):
            _report_missing(value, path, setting, written, report)
        return None

    def _component_finds(self, value: str) -> bool:
        from robocomp_dsl.runtime.config.data_file import data_file  # noqa: PLC0415 - rarely needed
        from robocomp_dsl.runtime.config.search_environment import (  # noqa: PLC0415
            SearchEnvironment,
        )
        from robocomp_dsl.runtime.parameters.errors import ConfigError  # noqa: PLC0415

        config = self.config or self.folder / _CONFIGURATION
        environment = SearchEnvironment.from_environ(working=self.folder)
        if any(_exists(folder / value) for folder in (config.parent, self.folder)):
            return True
        try:
            data_file(value, "", config, environment)
        except ConfigError:
            return False
        return True


def _exists(path: Path) -> bool:
    try:
        return path.exists()
    except (OSError, ValueError):  # a name that is too long, or with a null character
        return False


def _report_missing(
    value: str, path: Path, setting: Setting, written: Node, report: Report
) -> None:
    try:
        known = sorted(entry.name for entry in os.scandir(path.parent))
    except (OSError, ValueError):
        known = []
    near = nearest(path.name, known)
    place = setting.value.span.source.path.name
    guess = (Path(value).parent / near).as_posix() if near else ""
    report.add(
        codes.MISSING_FILE,
        written.span,
        f"cannot find `{path}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"`{setting.key.text}` is a path, relative to the folder of `{place}`",
        fix=replace_fix(written.span, f'"{guess}"') if guess else None,
    )
