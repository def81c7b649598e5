"""What the documentation names exists: methods of the runtime, and files of shipped components."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.runtime import Component, parameters
from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.machine import Machine
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.types import Proxy
from tests.docs.blocks import ROOT

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
OWNERS: dict[str, type] = {
    r"self\.machine\.(\w+)": Machine,
    r"self\.clock\.(\w+)": Clock,
    r"self\.params\.(set|save)\(": Parameters,
    r"`proxy\.(\w+)": Proxy,
    r"^\| `(\w+)\(\)` \| (?:once|every period|before an Emergency)": Component,
}
"""Where a member is named in the text → the class that has it."""
READMES = sorted(ROOT.glob("components/*/README.md"))


@pytest.mark.parametrize("pattern", OWNERS)
def test_members_named_in_the_documentation_exist(pattern: str) -> None:
    text = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
    named = set(re.findall(pattern, text, re.MULTILINE))
    assert named
    assert {name for name in named if not hasattr(OWNERS[pattern], name)} == set()


def test_exceptions_named_in_the_documentation_exist() -> None:
    assert hasattr(parameters, "ParameterRejected")


@pytest.mark.parametrize("readme", READMES, ids=lambda path: path.parent.name)
def test_files_named_in_a_component_readme_exist(readme: Path) -> None:
    cells = re.findall(r"^\| (`[^|]+`) \|", readme.read_text(encoding="utf-8"), re.MULTILINE)
    named = [name for cell in cells for name in re.findall(r"`([\w/]+\.\w+)`", cell)]
    assert [name for name in named if not (readme.parent / name).exists()] == []
