"""Repairs of identifiers: misspelled keywords, invalid names, strings without quotes.

In: the context of a syntax error. Out: possible repairs, the most likely first.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext
from robocomp_dsl.syntax.recovery.repair import Repair
from robocomp_dsl.syntax.recovery.repair_punctuation import IDENTIFIER

_FOREIGN_MODIFIERS = {
    "in": "parameters are inputs unless they are marked `out`",
    "inout": "declare an input and an `out` parameter",
    "const": "values are passed by copy; IDSL has no constants",
    "signed": "`short`, `int` and `long` are signed",
    "static": "",
    "virtual": "",
    "local": "",
    "optional": "",
    "oneway": "write `[command]` before an operation without a reply",
    "async": "write `[command]` before an operation without a reply",
    "typedef": "",
}
"""Modifiers of Slice and C++ before a type, and the alternative in IDSL."""

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
"""Keywords of other languages and their equivalents."""

_UNQUOTED_WORD = re.compile(r"[^\s;{}\",]{1,400}")
_UNQUOTED_WORDS = re.compile(r"[^\s;{}\",]{1,400}(?:[ \t]+[^\s;{}\",]{1,400}){1,20}(?=[ \t]*;)")
_OPEN_BRACKET = re.compile(r"\[[^\s\[\]{};,\"]+")
_BARE_NAME = re.compile(r"[^\s;{}()<>\[\],:=\"'/#.]{1,400}")


def keyword(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """A misspelled keyword, or one with the wrong case in a case-sensitive language."""
    token = context.lookahead[0]
    texts = {
        context.tables.terminal_texts[k]: k
        for k in accepted
        if k in context.tables.keyword_terminals
    }
    if not IDENTIFIER.fullmatch(token.text):
        return
    yield from _in_two_words(context, texts)
    other = _SYNONYMS.get(token.text.lower(), "")
    meant = nearest(token.text, texts) or (other if other in texts else None)
    if not meant or texts[meant] == token.kind:
        return
    same = meant.lower() == token.text.lower()
    yield Repair(
        codes.KEYWORD_CASE if same else codes.MISSPELLED_KEYWORD,
        token.start,
        token.end,
        f"`{token.text}` is not a keyword",
        label=f"the keyword is `{meant}`" if same else f"did you mean `{meant}`?",
        title=f"write `{meant}`",
        edits=((token.start, token.end, meant),),
        replacement=(Token(texts[meant], meant, token.start, token.end),),
        skip=1,
        required=1,
        is_certain=True,
    )


def _in_two_words(context: ErrorContext, texts: Mapping[str, str]) -> Iterator[Repair]:
    """`subscribes to`, `initial state`."""
    first, second = (*context.lookahead[:2], context.lookahead[-1])[:2]
    together = (first.text + second.text).lower()
    meant = next((text for text in texts if text.replace("_", "").lower() == together), None)
    if not meant:
        return
    yield Repair(
        codes.MISSPELLED_KEYWORD,
        first.start,
        second.end,
        f"`{first.text} {second.text}` is not a keyword",
        label=f"the keyword is `{meant}`",
        title=f"write `{meant}`",
        edits=((first.start, second.end, meant),),
        replacement=(Token(texts[meant], meant, first.start, second.end),),
        skip=2,
        required=1,
        is_certain=True,
    )


def foreign_modifier(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """`in float x`: a modifier of another language before a type, which was read as the type."""
    if context.tables.language != "idsl" or len(item) < 2:
        return
    word, name = item[-2:]
    if word.text not in _FOREIGN_MODIFIERS or not IDENTIFIER.fullmatch(name.text):
        return
    yield Repair(
        codes.UNEXPECTED,
        word.start,
        word.end,
        f"IDSL has no `{word.text}`",
        help=_FOREIGN_MODIFIERS[word.text],
        title=f"delete `{word.text}`",
        edits=((word.start, name.start, ""),),
        replacement=(*item[:-2], name),
        keep=keep,
        required=1,
        is_certain=True,
    )


def unquoted_string(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """A string without quotes: one word, or all words up to the `;`."""
    token = context.lookahead[0]
    if "STRING" not in accepted or "ID" in accepted or token.kind in ("STRING", END):
        return
    for pattern in (_UNQUOTED_WORD, _UNQUOTED_WORDS):
        run = pattern.match(context.source.text, token.start)
        if not run:
            return
        right = f'"{run.group()}"'
        yield Repair(
            codes.UNQUOTED_STRING,
            token.start,
            run.end(),
            "strings need quotes",
            label=f"write {right}",
            title="add the quotes",
            edits=((token.start, run.end(), right),),
            replacement=(Token("STRING", right, token.start, run.end()),),
            skip=_tokens_before(context, run.end()),
            required=1,
            is_certain=True,
        )


def quoted_identifier(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """A name or a number in quotes."""
    token = context.lookahead[0]
    inside = token.text[1:-1]
    if token.kind != "STRING" or "STRING" in accepted:
        return
    if "ID" in accepted and IDENTIFIER.fullmatch(inside):
        kind, noun = "ID", "name"
    elif "NUMBER" in accepted and inside.isdecimal() and inside.isascii():
        kind, noun = "NUMBER", "number"
    else:
        return
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        token.end,
        f"a {noun} is written without quotes",
        title=f"write `{inside}`",
        edits=((token.start, token.end, inside),),
        replacement=(Token(kind, inside, token.start, token.end),),
        skip=1,
        required=1,
        is_certain=True,
    )


def interface_file_suffix(context: ErrorContext) -> Iterator[Repair]:
    """`requires Laser.idsl`: a file name instead of an interface name."""
    before, suffix = context.previous, ".idsl"
    end = before.end + len(suffix)
    written = context.source.text[before.end : end + 1]
    if context.tables.language != "cdsl" or before.kind != "ID" or written[:5] != suffix:
        return
    if IDENTIFIER.match(written, len(suffix)):
        return
    yield Repair(
        codes.UNEXPECTED,
        before.end,
        end,
        f"write the name of the interface without a suffix: `{before.text}`",
        title=f"delete `{suffix}`",
        edits=((before.end, end, ""),),
        skip=_tokens_before(context, end),
        required=1,
        is_certain=True,
    )


def open_bracket(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`[mm` without its `]`."""
    token = context.lookahead[0]
    run = _OPEN_BRACKET.match(context.source.text, token.start)
    if "BRACKETED" not in accepted or not run or token.kind != "STRAY":
        return
    text = f"{run.group()}]"
    yield Repair(
        codes.MISSING_PUNCTUATION,
        run.end(),
        run.end(),
        f"missing `]` after `{run.group()}`",
        title="add `]`",
        edits=((run.end(), run.end(), "]"),),
        replacement=(Token("BRACKETED", text, token.start, run.end()),),
        skip=_tokens_before(context, run.end()),
        required=1,
        is_certain=True,
    )


def type_first(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`int a` where the name precedes the type."""
    token = context.lookahead[0]
    if "ID" not in accepted or not token.kind.endswith("_TYPE"):
        return
    name = context.lookahead[1]
    if name.kind != "ID" or name.text in ("true", "false"):
        return
    right = f"{name.text} {token.text}"
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        name.end,
        f"the name precedes the type: `{right}`",
        title=f"write `{right}`",
        edits=((token.start, name.end, right),),
        replacement=(name, Token(token.kind, token.text, name.end, name.end)),
        skip=2,
        required=1,
        is_certain=True,
    )


def invalid_name(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """A name with an invalid character, or with a digit at the start."""
    before, token = context.previous, context.lookahead[0]
    goes_on = before.end == token.start and bool(IDENTIFIER.fullmatch(before.text))
    if not goes_on and ("ID" not in accepted or token.kind not in ("NUMBER", "STRAY")):
        return
    run = _BARE_NAME.match(context.source.text, before.start if goes_on else token.start)
    if not run or run.end() <= token.start:
        return
    word = run.group()
    if IDENTIFIER.fullmatch(word.strip("&*")):
        return  # a C++ reference or pointer: surplus punctuation, not an invalid name
    right = _to_identifier(word)
    right = f"_{right}" if right[0].isdigit() else right
    yield Repair(
        codes.BAD_NAME,
        run.start(),
        run.end(),
        f"`{word}` is not a valid name",
        label="names consist of A to Z, digits and `_`, and do not begin with a digit",
        title=f"write `{right}`",
        edits=((run.start(), run.end(), right),),
        replacement=() if goes_on else (Token("ID", right, run.start(), run.end()),),
        skip=_tokens_before(context, run.end()),
        required=1,
        is_certain=goes_on,
    )


def _to_identifier(word: str) -> str:
    """`word` transliterated to ASCII letters, digits and `_`."""
    if word[:-1].isascii() and len(word) > 2 and word[-1].isalpha():
        word = word[:-1]  # an adjacent key was hit
    apart = unicodedata.normalize("NFKD", word.replace("ñ", "ny").replace("Ñ", "NY"))
    bare = "".join(char for char in apart if not unicodedata.combining(char))
    return re.sub(r"\W", "_", bare, flags=re.ASCII)


def _tokens_before(context: ErrorContext, end: int) -> int:
    return sum(token.start < end for token in context.lookahead if token.kind != END)
