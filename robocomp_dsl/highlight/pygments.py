"""Pygments lexers of the languages, found by Sphinx and MkDocs as `idsl`, `cdsl` and so on.

In: a text. Out: tokens of Pygments. This is the only module that needs Pygments.
"""

from __future__ import annotations

from typing import Any, ClassVar

from pygments import token
from pygments.lexer import RegexLexer, bygroups

from robocomp_dsl.highlight.rules import HighlightRule, contexts
from robocomp_dsl.highlight.table import words

STYLES = {
    "": token.Text,
    "text": token.Name,
    "keyword": token.Keyword,
    "declaration": token.Keyword.Declaration,
    "modifier": token.Keyword.Reserved,
    "legacy": token.Keyword.Pseudo,
    "value": token.Name.Constant,
    "truth": token.Keyword.Constant,
    "type": token.Keyword.Type,
    "pattern": token.Name.Decorator,
    "number": token.Number,
    "unit": token.Name.Attribute,
    "string": token.String,
    "comment": token.Comment,
    "doc": token.String.Doc,
    "operator": token.Operator,
    "punctuation": token.Punctuation,
    "name": token.Name.Class,
    "field": token.Name.Variable,
    "function": token.Name.Function,
}


def _entry(rule: HighlightRule) -> tuple[Any, ...]:
    kinds = [STYLES[item] for item in rule.styles]
    style = bygroups(*kinds) if len(kinds) > 1 else kinds[0] if kinds else token.Text  # type: ignore[no-untyped-call]
    step = (rule.push,) if rule.push else ("#pop",) if rule.pop else ()
    return (rule.pattern, style, *step)


def _states(language: str) -> dict[str, list[Any]]:
    return {
        name: [
            *map(_entry, context.rules),
            (r"\s+", token.Whitespace),
            (r"[^\s*/]+|." if context.style else ".", STYLES[context.style]),
        ]
        for name, context in contexts(words(language)).items()
    }


class IdslLexer(RegexLexer):
    """Interfaces."""

    name = "IDSL"
    aliases: ClassVar = ["idsl"]
    filenames: ClassVar = ["*.idsl"]
    tokens: ClassVar = _states("idsl")


class CdslLexer(RegexLexer):
    """Components."""

    name = "CDSL"
    aliases: ClassVar = ["cdsl"]
    filenames: ClassVar = ["*.cdsl"]
    tokens: ClassVar = _states("cdsl")


class PdslLexer(RegexLexer):
    """Parameters."""

    name = "PDSL"
    aliases: ClassVar = ["pdsl"]
    filenames: ClassVar = ["*.pdsl"]
    tokens: ClassVar = _states("pdsl")


class DdslLexer(RegexLexer):
    """Deployments."""

    name = "DDSL"
    aliases: ClassVar = ["ddsl"]
    filenames: ClassVar = ["*.ddsl"]
    tokens: ClassVar = _states("ddsl")


class BdslLexer(RegexLexer):
    """Bridges."""

    name = "BDSL"
    aliases: ClassVar = ["bdsl"]
    filenames: ClassVar = ["*.bdsl"]
    tokens: ClassVar = _states("bdsl")


class SmdslLexer(RegexLexer):
    """State machines."""

    name = "SMDSL"
    aliases: ClassVar = ["smdsl"]
    filenames: ClassVar = ["*.smdsl"]
    tokens: ClassVar = _states("smdsl")
