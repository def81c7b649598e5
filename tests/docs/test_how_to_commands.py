"""Commands in how-to guides and reference pages exist, and have the options that are shown."""

from __future__ import annotations

import re
import shlex

import click
import pytest

from robocomp_dsl.cli.rcdeploy.main import program as rcdeploy
from robocomp_dsl.cli.rcgen.main import program as rcgen
from tests.docs.blocks import ROOT, blocks

PROGRAMS: dict[str, click.Group] = {"rcgen": rcgen, "rcdeploy": rcdeploy}
FOLDERS = ("how-to", "reference", "explanation")
_INLINE = re.compile(r"`((?:rcgen|rcdeploy) [^`]+)`")


def _shown() -> list[str]:
    pages = [page for folder in FOLDERS for page in sorted((ROOT / "docs" / folder).glob("*.md"))]
    lines = [
        line.partition("#")[0] if " #" in line else line
        for page in pages
        for block in blocks(page)
        if block.language == "sh"
        for line in block.text.splitlines()
    ]
    inline = [m for page in pages for m in _INLINE.findall(page.read_text(encoding="utf-8"))]
    parts = [part.strip() for line in lines for part in line.split("&&")]
    commands = [part for part in [*parts, *inline] if part.split(" ")[0] in PROGRAMS]
    return sorted(set(commands))


@pytest.mark.parametrize("line", _shown())
def test_shown_command_exists_with_its_options(line: str) -> None:
    name, *words = shlex.split(line.replace("…", ""))
    command: click.Command = PROGRAMS[name]
    # `rcdeploy app.ddsl plan` is `rcdeploy plan app.ddsl`; without a command it is `up`.
    if name == "rcdeploy" and words[0].endswith(".ddsl"):
        words = [words[1], words[0], *words[2:]] if len(words) > 1 else ["up", *words]
    if words[0] == "hosts" and words[1].endswith(".ddsl"):
        words.insert(1, "show")
    context = click.Context(command)
    while isinstance(command, click.Group) and words and not words[0].startswith("-"):
        found = command.get_command(context, words[0])
        assert found, f"no command {words[0]}"
        command, words = found, words[1:]
    known = {option for parameter in command.params for option in parameter.opts} | {"--help"}
    used = {word.partition("=")[0] for word in words if word.startswith("-")}
    assert used <= known
