"""Corrections of words: misspelt keywords, names that are none, texts without quotes.

In: the situation of a parser that is stuck. Out: what could be meant, the likeliest first.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.repair import Repair
from robocomp_dsl.syntax.situation import Situation, quote
from robocomp_dsl.syntax.tables import END

WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_BARE_TEXT = re.compile(r"[^\s;{}\",]{1,400}")
_OPEN_BRACKET = re.compile(r"\[[^\s\[\]{};,\"]+")
_BARE_NAME = re.compile(r"[^\s;{}()<>\[\],:=\"'/#.]{1,400}")


def keyword(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A keyword with a slip, or in capitals where case counts."""
    token = situation.ahead[0]
    texts = {situation.tables.texts[k]: k for k in accepted if k in situation.tables.words}
    meant = nearest(token.text, texts) if WORD.fullmatch(token.text) else None
    if not meant:
        return
    if texts[meant] == token.kind:
        return
    same = meant.lower() == token.text.lower()
    yield Repair(
        codes.KEYWORD_CASE if same else codes.MISSPELT_KEYWORD,
        token.start,
        token.end,
        f"`{token.text}` is no keyword",
        label=f"the keyword is `{meant}`" if same else f"did you mean `{meant}`?",
        title=f"write `{meant}`",
        edits=((token.start, token.end, meant),),
        put=(Token(texts[meant], meant, token.start, token.end),),
        skip=1,
        need=1,
    )


def bare_text(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A text without quotes."""
    token = situation.ahead[0]
    run = _BARE_TEXT.match(situation.source.text, token.start)
    if "STRING" not in accepted or "ID" in accepted or not run or token.kind in ("STRING", END):
        return
    right = f'"{run.group()}"'
    yield Repair(
        codes.UNQUOTED_TEXT,
        token.start,
        run.end(),
        "a text stands in quotes",
        label=f"write {right}",
        title="add the quotes",
        edits=((token.start, run.end(), right),),
        put=(Token("STRING", right, token.start, run.end()),),
        skip=_tokens_before(situation, run.end()),
        need=1,
    )


def open_bracket(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """`[mm` without its `]`."""
    token = situation.ahead[0]
    run = _OPEN_BRACKET.match(situation.source.text, token.start)
    if "BRACKETED" not in accepted or not run or token.kind != "STRAY":
        return
    text = f"{run.group()}]"
    yield Repair(
        codes.MISSING_SIGN,
        run.end(),
        run.end(),
        f"`]` is missing behind `{run.group()}`",
        title="add `]`",
        edits=((run.end(), run.end(), "]"),),
        put=(Token("BRACKETED", text, token.start, run.end()),),
        skip=_tokens_before(situation, run.end()),
        need=1,
    )


def type_first(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """`int a` where the name stands in front of its type."""
    token = situation.ahead[0]
    if "ID" not in accepted or not token.kind.endswith("_TYPE"):
        return
    name = situation.ahead[1]
    if name.kind != "ID":
        return
    right = f"{name.text} {token.text}"
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        name.end,
        f"the name stands in front of the type: `{right}`",
        title=f"write `{right}`",
        edits=((token.start, name.end, right),),
        put=(name, Token(token.kind, token.text, name.end, name.end)),
        skip=2,
        need=1,
    )


def bad_name(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A name with a sign in it that names cannot have, or with a digit in front."""
    before, token = situation.before, situation.ahead[0]
    goes_on = before.end == token.start and bool(WORD.fullmatch(before.text))
    if not goes_on and ("ID" not in accepted or token.kind not in ("NUMBER", "STRAY")):
        return
    run = _BARE_NAME.match(situation.source.text, before.start if goes_on else token.start)
    if not run or run.end() <= token.start:
        return
    word = run.group()
    right = re.sub(r"\W", "_", word, flags=re.ASCII)
    right = f"_{right}" if right[0].isdigit() else right
    yield Repair(
        codes.BAD_NAME,
        run.start(),
        run.end(),
        f"`{word}` is not a name",
        label="names have the letters A to Z, digits and `_`, and begin with no digit",
        title=f"write `{right}`",
        edits=((run.start(), run.end(), right),),
        put=() if goes_on else (Token("ID", right, run.start(), run.end()),),
        skip=_tokens_before(situation, run.end()),
        need=1,
    )


def no_name(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A block without a name."""
    token = situation.ahead[0]
    if "ID" not in accepted or token.kind != "LBRACE":
        return
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        token.end,
        f"a name is missing behind {quote(situation.before)}",
        put=(Token("ID", "unnamed", token.start, token.start),),
    )


def _tokens_before(situation: Situation, end: int) -> int:
    return sum(token.start < end for token in situation.ahead if token.kind != END)
