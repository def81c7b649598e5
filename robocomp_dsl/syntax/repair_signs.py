"""Corrections of signs: a `;` that is missing, a comma too many, one bracket for another.

In: the situation of a parser that is stuck. Out: what could be meant, the likeliest first.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.repair import Repair
from robocomp_dsl.syntax.situation import Situation, quote
from robocomp_dsl.syntax.tables import END

WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_PUNCTUATION = re.compile(r"\W+")
_MISSED = (",", ")", "(", "{", ">", "<", ":", "->", "=>", ".", "=")
_ARROWS = ("->", "=>")
_ANY_ARROW = re.compile(r"[-=]+[ \t]*>+|<[-=]+|[→⇒]")
_CLOSING = {")": "(", "]": "[", ">": "<"}
_HIDDEN = re.compile(r"[ \t]*//[^\n]*?([)}\]>]*;)[ \t]*$", re.MULTILINE)


_MANUAL = (
    "in the manual `[…]` is what may be left out, `*[…]` what may be repeated; neither is written"
)


def semicolon(situation: Situation) -> Iterator[Repair]:
    """Only the `;` is missing. Where the line or block ends anyway, nothing is in doubt."""
    before, token = situation.before, situation.ahead[0]
    clear = situation.new_line() or before.kind == "RBRACE" or token.kind in ("RBRACE", END)
    yield Repair(
        codes.LEGACY_SEMICOLON if clear else codes.MISSING_SEMICOLON,
        before.end,
        before.end,
        f"`;` is missing behind {quote(before)}",
        label="what is behind `//` is not read" if _comment_follows(situation) else "",
        title="add `;`",
        edits=((before.end, before.end, ";"),),
        put=(Token("_SEMI", ";", before.end, before.end),),
        need=0 if before.kind == "RBRACE" else 1 if clear else 3,
    )


def _comment_follows(situation: Situation) -> bool:
    return bool(_HIDDEN.match(situation.source.text, situation.before.end))


def hidden(situation: Situation) -> Iterator[Repair]:
    """`Qt(QWidget//QDialog);`: the statement ends inside of a comment."""
    before, end = situation.before, situation.before.end
    comment = _HIDDEN.match(situation.source.text, end)
    if not comment or not situation.new_line():
        return
    signs = [(situation.tables.signs.get(sign, "_SEMI"), sign) for sign in comment[1]]
    yield Repair(
        codes.MISSING_SIGN,
        end,
        end,
        f"`{comment[1]}` is missing behind {quote(before)}",
        label="what is behind `//` is not read",
        title=f"add `{comment[1]}`",
        edits=((end, end, comment[1]),),
        put=tuple(Token(kind, sign, end, end) for kind, sign in signs),
        need=1,
    )


def semicolon_earlier(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
    """The last word that fitted began a line, and with a `;` before it all would fit."""
    if len(item) < 2 or "\n" not in situation.source.text[item[-2].end : item[-1].start]:
        return
    end = item[-2].end
    yield Repair(
        codes.LEGACY_SEMICOLON,
        end,
        end,
        f"`;` is missing behind {quote(item[-2])}",
        title="add `;`",
        edits=((end, end, ";"),),
        put=(*item[:-1], Token("_SEMI", ";", end, end), item[-1]),
        keep=keep,
    )


def _signs(situation: Situation, accepted: list[str]) -> list[tuple[str, str]]:
    """Terminal and text of the punctuation that may come next, what is likely missed first."""
    texts = {situation.tables.texts.get(kind, ""): kind for kind in accepted}
    optional = "_SEMI" in accepted
    return [(texts[t], t) for t in _MISSED if t in texts and not (t == "=" and optional)]


def other_bracket(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """The end of a block that was also begun with another bracket than `{`."""
    token = situation.ahead[0]
    if "RBRACE" not in accepted or token.text not in _CLOSING or not situation.opened:
        return
    if situation.source.text[situation.opened[-1].start] != _CLOSING[token.text]:
        return
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        token.end,
        f"a block ends with `}}`, not with {quote(token)}",
        title="write `}`",
        edits=((token.start, token.end, "}"),),
        put=(Token("RBRACE", "}", token.start, token.end),),
        skip=1,
        need=1,
    )


def other_sign(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """One punctuation mark for another."""
    token = situation.ahead[0]
    if not _PUNCTUATION.fullmatch(token.text) or token.kind == "RBRACE":
        return
    for kind, text in [*_signs(situation, accepted), ("_SEMI", ";")]:
        if token.kind == "STRAY" and token.text not in text:
            continue
        yield Repair(
            codes.UNEXPECTED,
            token.start,
            token.end,
            title=f"write `{text}`",
            edits=((token.start, token.end, text),),
            put=(Token(kind, text, token.start, token.end),),
            skip=1,
        )


def arrow(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """`-->`, `= >`, `<-` or `→` for the arrow of the language."""
    texts = {situation.tables.texts.get(kind, ""): kind for kind in accepted}
    meant = next((one for one in _ARROWS if one in texts), "")
    start = situation.ahead[0].start
    run = _ANY_ARROW.match(situation.source.text, start)
    if not meant or not run:
        return
    yield Repair(
        codes.UNEXPECTED,
        start,
        run.end(),
        f"the arrow is written `{meant}`",
        title=f"write `{meant}`",
        edits=((start, run.end(), meant),),
        put=(Token(texts[meant], meant, start, run.end()),),
        skip=sum(one.start < run.end() for one in situation.ahead if one.kind != END),
        need=1,
    )


def surplus(situation: Situation) -> Iterator[Repair]:
    """One token too many."""
    token = situation.ahead[0]
    if token.kind in (END, "_SEMI", "RBRACE"):
        return
    if situation.states[-1] in situation.tables.restarts and situation.ahead[1].kind == "_SEMI":
        return  # a whole statement too many, and not a word
    stray = token.kind == "STRAY"
    manual = situation.tables.language == "smdsl" and (
        token.text in ("[parallel]", "]") or (token.text[0] in "[*" and token.kind == "STRAY")
    )
    shown = quote(token) if token.text.isprintable() else f"U+{ord(token.text[0]):04X}"
    yield Repair(
        codes.STRAY_CHARACTER if stray else codes.UNEXPECTED,
        token.start,
        token.end,
        message=f"{shown} has no meaning here" if stray else "",
        help=_MANUAL if manual else "",
        title=f"delete {shown}",
        edits=((token.start, token.end, ""),),
        skip=1,
        need=0 if stray else 3,
    )


def missing_sign(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A punctuation mark is missing."""
    at = situation.before.end
    for kind, text in _signs(situation, accepted):
        yield Repair(
            codes.MISSING_SIGN,
            at,
            at,
            f"`{text}` is missing behind {quote(situation.before)}",
            title=f"add `{text}`",
            edits=((at, at, text),),
            put=(Token(kind, text, at, at),),
            # In `a b c` another one is missing behind the next word.
            need=1 if text == "," and WORD.fullmatch(situation.ahead[0].text) else 3,
        )
