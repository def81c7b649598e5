"""Corrections of words: misspelt keywords, names that are none, texts without quotes.

In: the situation of a parser that is stuck. Out: what could be meant, the likeliest first.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping

from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.repair import Repair
from robocomp_dsl.syntax.repair_signs import WORD
from robocomp_dsl.syntax.situation import Situation, quote
from robocomp_dsl.syntax.tables import END

_FOREIGN = {
    "in": "a parameter goes in unless it is marked `out`",
    "inout": "what goes in and out is a parameter and an `out` parameter",
    "const": "values are copies, and there are no constants",
    "unsigned": "all numbers have a sign; `long` has 64 bits",
    "signed": "all numbers have a sign",
    "static": "",
    "virtual": "",
    "local": "",
    "optional": "",
    "oneway": "write `[command]` in front of what is not answered",
    "async": "write `[command]` in front of what is not answered",
    "typedef": "",
}
"""Words that Slice or C++ writes in front of a type, and what IDSL has instead."""

_SYNONYMS = {
    "class": "struct",
    "union": "struct",
    "record": "struct",
    "namespace": "module",
    "package": "module",
    "include": "import",
    "using": "import",
    "service": "interface",
    "array": "sequence",
    "list": "sequence",
    "map": "dictionary",
    "provides": "implements",
    "offers": "implements",
    "uses": "requires",
    "needs": "requires",
    "parameters": "ComponentParams",
    "params": "ComponentParams",
    "system": "Deployment",
    "node": "component",
    "machine": "host",
    "events": "subscribesTo",
    "initial": "initial_state",
    "start": "initial_state",
    "final": "end_state",
    "end": "end_state",
}
"""What other languages call the same thing."""

_BARE_TEXT = re.compile(r"[^\s;{}\",]{1,400}")
_BARE_WORDS = re.compile(r"[^\s;{}\",]{1,400}(?:[ \t]+[^\s;{}\",]{1,400}){1,20}(?=[ \t]*;)")
_OPEN_BRACKET = re.compile(r"\[[^\s\[\]{};,\"]+")
_BARE_NAME = re.compile(r"[^\s;{}()<>\[\],:=\"'/#.]{1,400}")


def keyword(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A keyword with a slip, or in capitals where case counts."""
    token = situation.ahead[0]
    texts = {situation.tables.texts[k]: k for k in accepted if k in situation.tables.words}
    if not WORD.fullmatch(token.text):
        return
    yield from _in_two_words(situation, texts)
    other = _SYNONYMS.get(token.text.lower(), "")
    meant = nearest(token.text, texts) or (other if other in texts else None)
    if not meant or texts[meant] == token.kind:
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


def _in_two_words(situation: Situation, texts: Mapping[str, str]) -> Iterator[Repair]:
    """`subscribes to`, `initial state`."""
    first, second = (*situation.ahead[:2], situation.ahead[-1])[:2]
    together = (first.text + second.text).lower()
    meant = next((one for one in texts if one.replace("_", "").lower() == together), None)
    if not meant:
        return
    yield Repair(
        codes.MISSPELT_KEYWORD,
        first.start,
        second.end,
        f"`{first.text} {second.text}` is no keyword",
        label=f"the keyword is `{meant}`",
        title=f"write `{meant}`",
        edits=((first.start, second.end, meant),),
        put=(Token(texts[meant], meant, first.start, second.end),),
        skip=2,
        need=1,
    )


def foreign(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
    """`in float x`: the word of another language in front of a type, which was read as the type."""
    if situation.tables.language != "idsl" or len(item) < 2:
        return
    word, name = item[-2:]
    if word.text not in _FOREIGN or not WORD.fullmatch(name.text):
        return
    yield Repair(
        codes.UNEXPECTED,
        word.start,
        word.end,
        f"IDSL has no `{word.text}`",
        help=_FOREIGN[word.text],
        title=f"delete `{word.text}`",
        edits=((word.start, name.start, ""),),
        put=(*item[:-2], name),
        keep=keep,
        need=1,
    )


def bare_text(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A text without quotes: a word, or all words up to the `;`."""
    token = situation.ahead[0]
    if "STRING" not in accepted or "ID" in accepted or token.kind in ("STRING", END):
        return
    for pattern in (_BARE_TEXT, _BARE_WORDS):
        run = pattern.match(situation.source.text, token.start)
        if not run:
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


def quoted(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A name or a number in quotes."""
    token = situation.ahead[0]
    inside = token.text[1:-1]
    if token.kind != "STRING" or "STRING" in accepted:
        return
    if "ID" in accepted and WORD.fullmatch(inside):
        kind, what = "ID", "name"
    elif "NUMBER" in accepted and inside.isdecimal() and inside.isascii():
        kind, what = "NUMBER", "number"
    else:
        return
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        token.end,
        f"a {what} stands without quotes",
        title=f"write `{inside}`",
        edits=((token.start, token.end, inside),),
        put=(Token(kind, inside, token.start, token.end),),
        skip=1,
        need=1,
    )


def file_of_interface(situation: Situation) -> Iterator[Repair]:
    """`requires Laser.idsl`: the file for the interface in it."""
    before, suffix = situation.before, ".idsl"
    end = before.end + len(suffix)
    written = situation.source.text[before.end : end + 1]
    if situation.tables.language != "cdsl" or before.kind != "ID" or written[:5] != suffix:
        return
    if WORD.match(written, len(suffix)):
        return
    yield Repair(
        codes.UNEXPECTED,
        before.end,
        end,
        f"an interface is named without its file: `{before.text}`",
        title=f"delete `{suffix}`",
        edits=((before.end, end, ""),),
        skip=_tokens_before(situation, end),
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
    if WORD.fullmatch(word.strip("&*")):
        return  # as C++ writes references and pointers: a sign too many, and no name
    right = _plain(word)
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


def _plain(word: str) -> str:
    """`word` in the letters that names have, as people write it where there are no others."""
    if word[:-1].isascii() and len(word) > 2 and word[-1].isalpha():
        word = word[:-1]  # a key beside the one that was meant
    apart = unicodedata.normalize("NFKD", word.replace("ñ", "ny").replace("Ñ", "NY"))
    bare = "".join(sign for sign in apart if not unicodedata.combining(sign))
    return re.sub(r"\W", "_", bare, flags=re.ASCII)


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
