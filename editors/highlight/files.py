"""All files generated from the grammars: paths from the root of the project to texts."""

from __future__ import annotations

import json
from pathlib import Path

from editors.highlight import emacs, kate, textmate, vim, words
from robocomp_dsl.highlight.table import LANGUAGES

ROOT = Path(__file__).resolve().parents[2]
TABLE = "grammars/words.json"


def table_file() -> dict[str, str]:
    """The table of keywords, from the grammars."""
    return {TABLE: _json(words.table())}


def files() -> dict[str, str]:
    """The files of the editors, from the written table."""
    outputs = {"editors/emacs/robocomp-words.el": emacs.lisp()}
    for language in LANGUAGES:
        outputs[f"editors/vscode/syntaxes/{language}.tmLanguage.json"] = _json(
            textmate.grammar(language)
        )
        outputs[f"editors/vim/syntax/{language}.vim"] = vim.syntax(language)
        outputs[f"editors/kate/syntax/{language}.xml"] = kate.definition(language)
    return outputs


def _json(data: object) -> str:
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
