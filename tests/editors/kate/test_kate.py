"""The definitions of KDE's editors, in KDE's own engine."""

from __future__ import annotations

import html
import os
import re
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from tests.support.real_editor import missing

ROOT = Path(__file__).parents[3]
SYNTAX = ROOT / "editors" / "kate" / "syntax"
PROGRAMS = ("kate-syntax-highlighter", "ksyntaxhighlighter6")
_SPAN = re.compile(r'<span style="([^"]*)">(.*?)</span>')

# Colours of the theme Breeze Light; types, names and keywords inside a statement share one.
COLOURS = {
    "font-weight:bold;": "keyword",
    "color:#0057ae;": "blue",
    "color:#b08000;": "number",
    "color:#aa5500;": "value",
    "color:#ca60ca;": "operator",
    "color:#644a9b;": "function",
    "color:#3daee9;": "unit",
    "color:#bf0303;": "warning",
}
CASES = [
    ("cdsl", "Component requires {", "keyword:Component blue:requires"),
    ("cdsl", "requires Component as requires;", "keyword:requires blue:as"),
    ("cdsl", "useQt qt4; language python;", "warning:useQt keyword:language value:python"),
    ("idsl", "bool module; float x [dB];", "blue:bool blue:float unit:[dB]"),
    (
        "idsl",
        "[query] int say(Req out, out int d) throws No;",
        "operator:[query] blue:int function:say blue:out blue:int blue:throws",
    ),
    ("pdsl", "a int 1 live; live int;", "blue:a blue:int number:1 blue:live blue:live blue:int"),
    ("pdsl", "mode {int, live} live;", "blue:mode value:{int, live} blue:live"),
    (
        "ddsl",
        "restart on-failure max 5;",
        "keyword:restart value:on-failure blue:max number:5",
    ),
    (
        "ddsl",
        "connect a.on -> b.from { depth 1; };",
        "keyword:connect operator:. operator:-> operator:. keyword:depth number:1",
    ),
    ("smdsl", "on => over on after;", "operator:=> blue:on"),
    (
        "bdsl",
        "rate 50 Hz; rate = f(a) to [rad];",
        "keyword:rate number:50 Hz operator:= function:f blue:to unit:[rad]",
    ),
]


@pytest.mark.parametrize("file", sorted(SYNTAX.glob("*.xml")), ids=lambda file: file.name)
def test_kate_syntax_defines_all_referenced_contexts_and_styles(file: Path) -> None:
    tree = ET.parse(file)
    names = {item.get("name") for item in tree.iter("context")}
    styles = {item.get("name") for item in tree.iter("itemData")}
    for item in tree.iter("RegExpr"):
        target = str(item.get("context")).removeprefix("#pop!")
        assert target in names | {"#pop", "#stay"}
        assert item.get("attribute") in styles | {None}
        assert item.get("lookAhead") == "1" or item.get("attribute")


@pytest.fixture
def engine(tmp_path: Path) -> str:
    found = next((path for item in PROGRAMS if (path := shutil.which(item))), None)
    if found is None:
        missing("kate-syntax-highlighter")
    folder = tmp_path / "org.kde.syntax-highlighting"
    folder.mkdir()
    shutil.copytree(SYNTAX, folder / "syntax")
    return found


def coloured(engine: str, language: str, text: str, tmp_path: Path) -> str:
    """The words that have a colour of `COLOURS`, with its name."""
    file = tmp_path / f"x.{language}"
    file.write_text(text + "\n", encoding="utf-8")
    done = subprocess.run(
        [engine, "-s", language.upper(), "-t", "Breeze Light", file],
        env=os.environ | {"XDG_DATA_HOME": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert not done.stderr, done.stderr
    spans = _SPAN.findall(done.stdout)
    return " ".join(f"{COLOURS[s]}:{html.unescape(t)}" for s, t in spans if s in COLOURS)


@pytest.mark.editors
@pytest.mark.parametrize(("language", "text", "expected"), CASES)
def test_kate_highlights_words_by_context(
    engine: str, language: str, text: str, expected: str, tmp_path: Path
) -> None:
    assert coloured(engine, language, text, tmp_path) == expected
