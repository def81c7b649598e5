"""Fixtures: YARP files as text, and their migration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.generate.write import write
from robocomp_dsl.migrate.yarp.migration import is_yarp_file, plan_yarp_files


@dataclass(frozen=True)
class MigratedFiles:
    """The files of a migration, and its findings as `file:line code: message`."""

    texts: dict[str, str]
    findings: list[str]
    severities: set[Severity]

    def has(self, *words: str) -> bool:
        """Whether one finding contains all words."""
        return any(all(word in finding for word in words) for finding in self.findings)


@pytest.fixture
def migrate(tmp_path: Path) -> Callable[..., MigratedFiles]:
    """`migrate({"demo.xml": text, …})`; the first file is migrated, and checked if it can be."""

    def run(files: dict[str, str], *more: str, tags: tuple[str, ...] = ()) -> MigratedFiles:
        folder, out = tmp_path / "old", tmp_path / "new"
        for name, text in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)
        paths = [folder / name for name in (next(iter(files)), *more)]
        assert all(is_yarp_file(path) for path in paths)
        report = Report()
        plan = plan_yarp_files(paths, out, report, tags=tags)
        write(out, plan.files)
        if not plan.worlds:
            check = Report()
            for deployment in plan.deployments:
                check_ddsl(out / deployment, Workspace(), check)
            assert [each.message for each in check if each.severity is Severity.ERROR] == []
        findings = [
            f"{each.span.source.path.name}:{each.span.start_position[0]} {each.code.id}:"
            f" {each.message}"
            for each in report.sorted()
        ]
        texts = {file.path: file.text for file in plan.files}
        return MigratedFiles(texts, findings, {each.severity for each in report})

    return run
