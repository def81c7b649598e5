"""Reference pages of the finding codes, from the data that `rcgen explain` prints.

In: the codes of all stages. Out: a page per hundred of codes (RC1xx, RC2xx, …), and their index.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

from robocomp_dsl.cli.rcgen.explain import all_codes
from robocomp_dsl.diagnostics import Code

FAMILIES = {
    "RC0": "Files",
    "RC1": "Syntax",
    "RC2": "Names, imports and components",
    "RC3": "Interfaces and types",
    "RC4": "Parameters",
    "RC5": "Deployments",
    "RC6": "Generation, exports and breaking changes",
    "RC7": "State machines and bridges",
    "RC8": "Worlds and touch",
    "RC9": "Starting and migrating",
}


def write(folder: Path) -> None:
    """Write one page per family of codes into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    for family, codes in groupby(all_codes().values(), key=lambda code: code.id[:3]):
        (folder / f"{family}xx.md").write_text(_page(family, list(codes)), encoding="utf-8")


def _page(family: str, codes: Iterable[Code]) -> str:
    return "\n".join([f"# {family}xx: {FAMILIES[family]}", "", *(_section(code) for code in codes)])


def _section(code: Code) -> str:
    body = "\n".join(_blocks(code.explanation.strip()))
    return f"({code.id.lower()})=\n## {code.id}: {code.title}\n\n*{code.severity}*\n\n{body}\n"


def _blocks(explanation: str) -> Iterable[str]:
    """Paragraphs unchanged; indented examples as fenced blocks."""
    for indented, lines in groupby(_joined(explanation), key=lambda line: line.startswith("    ")):
        text = "\n".join(lines)
        yield f"```text\n{textwrap.dedent(text).strip()}\n```" if indented else text


def _joined(explanation: str) -> Iterable[str]:
    """Lines; an empty line inside an example belongs to it."""
    lines = explanation.splitlines()
    for i, line in enumerate(lines):
        rest = (later for later in lines[i:] if later)
        inside = i > 0 and lines[i - 1].startswith("    ")
        yield "    " if not line and inside and next(rest, "").startswith("    ") else line
