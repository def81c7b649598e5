"""Every snippet, with the words that it proposes, is right in a file of its language."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from robocomp_dsl.check.languages import PARSERS
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from tests.support.real_editor import EDITORS

SNIPPETS = EDITORS / "vscode" / "snippets"

FRAMES = {
    "idsl": ("module M\n{\n", "\n};\n"),
    "cdsl": ("Component c\n{\n", "\n    language Python;\n};\n"),
    "pdsl": ("ComponentParams p\n{\n", "\n};\n"),
    "ddsl": ("Deployment d\n{\n", "\n};\n"),
    "smdsl": ("", ""),
    "bdsl": ("Bridge b\n{\n", "\n};\n"),
}
"""What surrounds a snippet that is not a file by itself; `DEEPER`: where it is another place."""

DEEPER = {
    ("cdsl", "Implements"): ("Component c\n{\n    Communications {\n", "\n    };\n};\n"),
    ("cdsl", "Requires"): ("Component c\n{\n    Communications {\n", "\n    };\n};\n"),
    ("cdsl", "Publishes"): ("Component c\n{\n    Communications {\n", "\n    };\n};\n"),
    ("cdsl", "Subscribes"): ("Component c\n{\n    Communications {\n", "\n    };\n};\n"),
    ("idsl", "Import"): ("", "\nmodule M\n{\n    interface I\n    {\n    };\n};\n"),
    ("cdsl", "Import"): (
        "",
        "\nComponent c\n{\n    Communications { requires I; };\n    language Python;\n};\n",
    ),
    ("ddsl", "Import"): ("", "\nDeployment d\n{\n    component c;\n};\n"),
    ("ddsl", "Set"): ("Deployment d\n{\n    component c {\n", "\n    };\n};\n"),
    ("bdsl", "Import"): ("", "\nBridge b\n{\n    input a : int;\n};\n"),
    ("smdsl", "Transition"): (
        "m\n{\n    initial_state from;\n    states to;\n    transitions\n    {\n",
        "\n    };\n};\n",
    ),
    ("smdsl", "Substates"): (
        "m\n{\n    initial_state a;\n    states state;\n    transitions { a => state; };\n};\n",
        "",
    ),
}
WHOLE = {"Module", "Component", "Parameters", "Deployment", "Machine", "Bridge"}

CASES = [
    (language, name)
    for language in FRAMES
    for name in json.loads((SNIPPETS / f"{language}.json").read_text())
]


def expanded(body: str | list[str]) -> str:
    """The text when a user takes everything as proposed."""
    text = body if isinstance(body, str) else "\n".join(body)
    text = text.replace("$0", "").replace("${TM_FILENAME_BASE}", "thing")
    before = None
    while before != text:
        before = text
        text = re.sub(r"\$\{\d+\|([^,|}]+)[^}]*\|\}", r"\1", text)
        text = re.sub(r"\$\{\d+:((?:[^${}]|\{[^${}]*\})*)\}", r"\1", text)
        text = re.sub(r"\$\{\d+\}", "", text)
    assert "$" not in text, text
    return text


@pytest.mark.parametrize(("language", "name"), CASES)
def test_vscode_snippet_parses_with_defaults(language: str, name: str) -> None:
    snippet = json.loads((SNIPPETS / f"{language}.json").read_text())[name]
    whole = name in WHOLE and (language, name) != ("ddsl", "Component")
    before, after = ("", "") if whole else DEEPER.get((language, name), FRAMES[language])
    text = before + expanded(snippet["body"]) + after
    report = Report()
    PARSERS[f".{language}"](Source(Path(f"thing.{language}"), text), report)
    assert [str(item) for item in report] == [], text
