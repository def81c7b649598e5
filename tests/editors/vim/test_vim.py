"""The groups that a real Vim gives to the words of each language."""

from __future__ import annotations

import os
import shutil
import subprocess
from itertools import groupby
from pathlib import Path

import pytest

from tests.support.real_editor import missing

pytestmark = pytest.mark.editors
ROOT = Path(__file__).parents[3]
PLUGIN = ROOT / "editors" / "vim"
PLAIN = ("", "Operator", "Statement")

CASES = [
    ("cdsl", "Component requires {", "Type:Component Identifier:requires"),
    ("cdsl", "requires Component as requires;", "Statement:requires Statement:as"),
    ("cdsl", "LANGUAGE python;", "Statement:LANGUAGE Constant:python"),
    ("cdsl", "useQt qt4;", "Todo:useQt"),
    ("cdsl", "period 50; // requires a;", "Statement:period Constant:50 Comment://_requires_a;"),
    ("idsl", "bool module = false;", "Type:bool Statement:= Constant:false"),
    (
        "idsl",
        "[query] int say(Req out, out float d) throws No;",
        "PreProc:[query] Type:int Identifier:say Statement:out Type:float Statement:throws",
    ),
    ("idsl", "enum Mood { module, out };", "Type:enum Identifier:Mood"),
    ("idsl", "/** module a */ struct B {", "Special:/**_module_a_*/ Type:struct Identifier:B"),
    (
        "pdsl",
        'string string "a" live;',
        'Identifier:string Type:string Constant:"a" Statement:live',
    ),
    (
        "pdsl",
        "mode {int, live} live;",
        "Identifier:mode Constant:{int,_live} Statement:live",
    ),
    ("pdsl", "rate float 5 [Hz];", "Identifier:rate Type:float Constant:5 Special:[Hz]"),
    (
        "ddsl",
        "restart on-failure max 5 in 60 s;",
        "Statement:restart Constant:on-failure Statement:max Constant:5 Statement:in"
        " Constant:60 Special:s",
    ),
    ("ddsl", "connect a.on -> b.from {", "Type:connect Statement:. Statement:-> Statement:."),
    (
        "smdsl",
        "on => over on after after 2 min;",
        "Statement:=> Statement:on Statement:after Constant:2 Special:min",
    ),
    ("smdsl", ":game parallel {", "Statement:: Statement:parallel"),
    (
        "bdsl",
        'input left : double[3] [deg] over yarp at "/a";',
        "Type:input Identifier:left Statement:: Type:double Constant:[3] Special:[deg]"
        ' Statement:over Statement:at Constant:"/a"',
    ),
    (
        "bdsl",
        "rate = f(a[0] to [rad]) * -2;",
        "Statement:= Identifier:f Constant:[0] Statement:to Special:[rad] Statement:* Constant:-2",
    ),
]


@pytest.fixture
def vim() -> str:
    found = shutil.which("vim")
    if found is None:
        missing("vim")
    return found


def run(vim: str, file: Path, script: Path, *more: str) -> Path:
    """Open a file with the plugin folder and nothing of the user's; what the script wrote."""
    out = file.with_suffix(".out")
    setup = (f"set nocp rtp^={PLUGIN}", "filetype plugin indent on", "syntax on")
    commands = [part for item in setup for part in ("--cmd", item)]
    subprocess.run(
        [vim, "-es", "-u", "NONE", "-i", "NONE", "-n", *commands, file, *more, "-S", script],
        env=os.environ | {"GROUPS_OUT": str(out), "HOME": str(file.parent)},
        stdin=subprocess.DEVNULL,
        timeout=60,
        check=False,
    )
    return out


@pytest.mark.parametrize(("language", "text", "expected"), CASES)
def test_vim_highlights_words_by_group(
    vim: str, language: str, text: str, expected: str, tmp_path: Path
) -> None:
    file = tmp_path / f"x.{language}"
    file.write_text(text + "\n", encoding="utf-8")
    groups = run(vim, file, Path(__file__).with_name("groups.vim")).read_text("utf-8")
    pairs = zip(groups.rstrip("\n").split(","), text, strict=True)
    runs = [(name, "".join(c for _, c in run)) for name, run in groupby(pairs, lambda p: p[0])]
    known = [f"{name}:{part.replace(' ', '_')}" for name, part in runs if name[:1].isupper()]
    assert " ".join(known) == expected


def test_vim_indentation_keeps_formatted_file(vim: str, tmp_path: Path) -> None:
    text = (
        "Deployment a\n{\n    component b\n    {\n        after c;\n        port 1;\n    };\n};\n"
    )
    file = tmp_path / "x.ddsl"
    file.write_text(text.replace("    ", ""), encoding="utf-8")
    script = tmp_path / "indent.vim"
    script.write_text("normal! gg=G\nwrite! $GROUPS_OUT\nqall!\n", encoding="utf-8")
    assert run(vim, file, script).read_text("utf-8") == text
