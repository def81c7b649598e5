"""The keywords of all languages for Emacs."""

from __future__ import annotations

from robocomp_dsl.highlight.table import LANGUAGES, words

_FRAME = """;;; robocomp-words.el --- Words of RoboComp's languages  -*- lexical-binding: t; -*-
;;; Commentary:
;; Written by `python -m editors.highlight' from the grammars; do not edit.
;;; Code:
(defconst robocomp-words
  '({})
  "For each language: whether the case of letters plays no part, and its words.")
(provide 'robocomp-words)
;;; robocomp-words.el ends here
"""


def lisp() -> str:
    """The table as Emacs Lisp."""
    rows = []
    for language in LANGUAGES:
        of = words(language)
        listed = [*of.keywords, *of.types, *of.truth, *of.patterns]
        strings = "\n     ".join(f'"{word}"' for word in sorted(set(listed)))
        rows.append(f"({language} {'t' if of.any_case else 'nil'}\n     {strings})")
    return _FRAME.format("\n    ".join(rows))
