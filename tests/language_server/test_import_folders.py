"""The editor resolves imports as the commands do: paths as written, `interfaces/` above, `-I`."""

from __future__ import annotations

from pathlib import Path

import click.testing
import pytest

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen import lsp as command
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server import server
from robocomp_dsl.language_server.features.document_links import links_of
from robocomp_dsl.language_server.session import Session

TEXT = """import "../types/Pose.idsl";
import "Above.idsl";
import "/opt/robocomp/interfaces/IDSLs/Listed.idsl";
module M { };
"""


def write(path: Path, name: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"module {name} {{ struct {name}T {{ int x; }}; }};\n")
    return path


def test_session_links_imports_to_the_files_that_the_check_loads(tmp_path: Path) -> None:
    expected = [
        write(tmp_path / "project" / "types" / "Pose.idsl", "Pose"),
        write(tmp_path / "project" / "interfaces" / "Above.idsl", "Above"),
        write(tmp_path / "listed" / "Listed.idsl", "Listed"),
    ]
    path = tmp_path / "project" / "component" / "Main.idsl"
    path.parent.mkdir()
    path.write_text(TEXT)
    session = Session(environ={"ROBOCOMP_INTERFACES": str(tmp_path / "listed")})
    assert [target for _, target in links_of(session, path)] == expected
    modules = check_idsl(path, Workspace([tmp_path / "listed"], {}), Report())
    assert modules is not None
    assert [module.path for module in modules[0].imports] == expected


def test_lsp_command_accepts_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[Path, ...]] = []

    def serve() -> int:
        folders = Session().workspace.import_resolver.search_path(tmp_path / "a.idsl")
        seen.append(tuple(folders))
        return 0

    monkeypatch.setenv("ROBOCOMP_INTERFACES", str(tmp_path / "third"))
    monkeypatch.setattr(server, "serve_stdio", serve)
    arguments = ["-I", str(tmp_path / "first"), "-I", str(tmp_path / "second")]
    click.testing.CliRunner().invoke(command.command, arguments)
    assert seen[0][1:4] == (tmp_path / "first", tmp_path / "second", tmp_path / "third")
