"""TextMate grammars (VS Code and others).

In: the contexts of a language. Out: the grammar as data. A pushed context becomes a pair of `begin`
and `end`; a rule that pops it becomes the `end`.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.highlight.rules import Context, HighlightRule, contexts
from robocomp_dsl.highlight.table import words

SCOPES = {
    "keyword": "keyword.other",
    "declaration": "storage.type",
    "modifier": "storage.modifier",
    "legacy": "invalid.deprecated",
    "value": "support.constant",
    "truth": "constant.language",
    "type": "support.type.primitive",
    "pattern": "entity.other.attribute-name.pattern",
    "number": "constant.numeric",
    "unit": "keyword.other.unit",
    "string": "string.quoted.double",
    "comment": "comment",
    "doc": "comment.block.documentation",
    "operator": "keyword.operator",
    "punctuation": "punctuation",
    "name": "entity.name.type",
    "field": "variable.parameter",
    "function": "entity.name.function",
}
"""Styles to the scopes that colour themes know."""


def grammar(language: str) -> dict[str, Any]:
    """The grammar of one language."""
    contexts_by_name = contexts(words(language))
    return {
        "name": language.upper(),
        "scopeName": f"source.{language}",
        "fileTypes": [language],
        "patterns": [{"include": "#root"}],
        "repository": {
            name: {
                "patterns": [
                    _pattern(rule, contexts_by_name, language)
                    for rule in item.rules
                    if not rule.pop
                ]
            }
            for name, item in contexts_by_name.items()
        },
    }


def _pattern(
    rule: HighlightRule, contexts_by_name: dict[str, Context], language: str
) -> dict[str, Any]:
    if not rule.push:
        return {"match": rule.pattern} | _captures(rule, "captures", language)
    inside = contexts_by_name[rule.push]
    ends = [item for item in inside.rules if item.pop]
    region: dict[str, Any] = {"begin": rule.pattern} | _captures(rule, "beginCaptures", language)
    region["end"] = "|".join(end.pattern for end in ends)
    if inside.style:
        return {
            "name": f"{SCOPES[inside.style]}.{language}",
            "begin": rule.pattern,
            "end": region["end"],
        }
    region["endCaptures"] = {"0": {"name": f"{SCOPES[ends[0].styles[0]]}.{language}"}}
    region["patterns"] = [{"include": f"#{rule.push}"}]
    return region


def _captures(rule: HighlightRule, key: str, language: str) -> dict[str, Any]:
    numbers = range(1, len(rule.styles) + 1) if len(rule.styles) > 1 else (0,)
    named = {
        str(number): {"name": f"{SCOPES[style]}.{language}"}
        for number, style in zip(numbers, rule.styles, strict=False)
        if style in SCOPES
    }
    return {key: named} if named else {}
