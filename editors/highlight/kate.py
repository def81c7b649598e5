"""Syntax definitions of KDE's editors.

In: the contexts of a language. Out: the XML. A rule of KDE has one style, so the name after the
first word of a statement has a context of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from xml.sax.saxutils import quoteattr

from robocomp_dsl.highlight.rules import NAME, Context, HighlightRule, contexts
from robocomp_dsl.highlight.table import words

STYLES = {
    "text": "dsNormal",
    "keyword": "dsKeyword",
    "declaration": "dsControlFlow",
    "modifier": "dsAttribute",
    "legacy": "dsWarning",
    "value": "dsConstant",
    "truth": "dsConstant",
    "type": "dsDataType",
    "pattern": "dsAnnotation",
    "number": "dsDecVal",
    "unit": "dsSpecialChar",
    "string": "dsString",
    "comment": "dsComment",
    "doc": "dsDocumentation",
    "operator": "dsOperator",
    "punctuation": "dsOthers",
    "name": "dsVariable",
    "field": "dsVariable",
    "function": "dsFunction",
}
_FRAME = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE language>
<!-- Written by `python -m editors.highlight` from the grammars; do not edit. -->
<language name="{NAME}" section="Other" version="1" kateversion="5.79" extensions="*.{name}"
          indenter="cstyle" casesensitive="1" license="MIT">
  <highlighting>
    <contexts>
{contexts}
    </contexts>
    <itemDatas>
{styles}
    </itemDatas>
  </highlighting>
  <general>
    <comments>
      <comment name="singleLine" start="//"/>
      <comment name="multiLine" start="/*" end="*/" region="comment"/>
    </comments>
    <keywords casesensitive="1"/>
  </general>
</language>
"""


def definition(language: str) -> str:
    """The definition of one language."""
    contexts_by_name = contexts(words(language))
    lines = [line for name, item in contexts_by_name.items() for line in _context(name, item)]
    styles = [f'      <itemData name="{name}" defStyleNum="{to}"/>' for name, to in STYLES.items()]
    return _FRAME.format(
        NAME=language.upper(),
        name=language,
        contexts="\n".join(lines),
        styles="\n".join(styles),
    )


def _context(name: str, context: Context) -> Iterator[str]:
    style = context.style or "text"
    yield f'      <context name="{name}" attribute="{style}" lineEndContext="#stay">'
    for rule in context.rules:
        yield from _rule(rule)
    if name == "root":
        yield f'        <RegExpr attribute="text" context="#stay" String={quoteattr(NAME)}/>'
    yield "      </context>"
    for rule in context.rules:
        if rule.push and len(rule.styles) > 1:
            yield from _declared(rule)


def _rule(rule: HighlightRule) -> Iterator[str]:
    declares = bool(rule.push) and len(rule.styles) > 1
    target = rule.push or ("#pop" if rule.pop else "#stay")
    pattern = rule.pattern
    if declares:
        target, pattern = f"{target}-name", pattern.removesuffix(rf"(?:(\s+)({NAME}))?")
    if not rule.styles:
        # KDE skips matches of length 0; with `lookAhead` a rule does not consume its match.
        pattern = pattern.removeprefix("(?=")[:-1]
    shown = f'attribute="{rule.styles[0]}"' if rule.styles else 'lookAhead="1"'
    yield f'        <RegExpr {shown} context="{target}" String={quoteattr(pattern)}/>'


def _declared(rule: HighlightRule) -> Iterator[str]:
    """The part after the first word of a statement that declares something."""
    rest = f"#pop!{rule.push}"
    yield (
        f'      <context name="{rule.push}-name" attribute="text" lineEndContext="{rest}" '
        f'fallthroughContext="{rest}">'
    )
    yield r'        <RegExpr attribute="text" context="#stay" String="\s+"/>'
    yield f'        <RegExpr attribute="name" context="{rest}" String={quoteattr(NAME)}/>'
    yield "      </context>"
