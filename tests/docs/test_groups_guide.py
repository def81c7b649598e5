"""The guide to groups is executed, as the tutorials are."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.deploy.rcdeploy_process import runtime_folder
from tests.docs.blocks import ROOT, blocks
from tests.docs.session import Session
from tests.docs.test_tutorials import environment as page_environment

PAGE = ROOT / "docs" / "how-to" / "groups.md"
environment = page_environment


def test_groups_guide_executes_as_shown(
    tmp_path: Path, environment: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    work = tmp_path / "work"
    work.mkdir()
    with runtime_folder(monkeypatch) as folder:
        variables = environment | {"XDG_RUNTIME_DIR": str(folder.parent)}
        with Session(work, variables) as session:
            for block in blocks(PAGE):
                session.execute(block)
