"""The guide to InnerModel is executed, as the tutorials are."""

from __future__ import annotations

from pathlib import Path

from tests.docs.blocks import ROOT, blocks
from tests.docs.session import Session
from tests.docs.test_tutorials import environment as page_environment

PAGE = ROOT / "docs" / "how-to" / "innermodel.md"
environment = page_environment


def test_innermodel_guide_executes_as_shown(tmp_path: Path, environment: dict[str, str]) -> None:
    with Session(tmp_path, environment) as session:
        for block in blocks(PAGE):
            session.execute(block)
