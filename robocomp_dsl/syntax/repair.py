"""Small corrections with which a broken text goes on to make sense.

In: the situation of a parser that is stuck. Out: the correction that lets most of the next tokens
fit, with what to tell the user about it; or None.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from robocomp_dsl.diagnostics import Code, Note, nearest
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.situation import WINDOW, Situation, quote
from robocomp_dsl.syntax.tables import END

_PUNCTUATION = re.compile(r"\W+")
_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_BARE_TEXT = re.compile(r"[^\s;{}\",]+")
_BARE_NAME = re.compile(r"[^\s;{}()<>\[\],:=\"'/#.]+")
_MISSED = (",", ")", "(", "{", ">", "<", ":", "->", ".", "=")
_CLOSED = ("RBRACE", "_SEMI")


@dataclass(frozen=True, slots=True)
class Repair:
    """Read `put` in the place of the next `skip` tokens, after dropping all but `keep` states.

    At least `need` of the tokens behind must fit. The rest is the finding: `edits` are the fix.
    An empty message stands for "expected …, found …", which the parser words.
    """

    code: Code
    start: int
    end: int
    message: str = ""
    label: str = ""
    help: str = ""
    notes: tuple[Note, ...] = ()
    title: str = ""
    edits: tuple[tuple[int, int, str], ...] = ()
    put: tuple[Token, ...] = ()
    skip: int = 0
    keep: int = 0
    need: int = 3

    def tell(self, findings: Findings, expected: str) -> None:
        """Report it."""
        findings.add(
            self.code,
            self.start,
            self.end,
            self.message or expected,
            label=self.label,
            help=self.help,
            notes=self.notes,
            fix=findings.fix(self.title, *self.edits) if self.edits else None,
        )


def choose(situation: Situation, item: list[Token], keep: int) -> Repair | None:
    """The best correction.

    `item` are the tokens since the start of the statement, which began with `keep` states.
    """
    best, best_progress = None, -1
    for made in _proposals(situation, item, keep):
        progress = _progress(situation, made)
        if progress > best_progress:
            best, best_progress = made, progress
    return best


def hopeless(situation: Situation) -> Repair:
    """No correction but the finding alone, for a statement that is given up."""
    start, end = situation.place()
    if situation.ahead[0].kind != END or not situation.opened:
        return Repair(codes.UNEXPECTED, start, end)
    opened = situation.opened[-1]
    return Repair(
        codes.UNCLOSED_BLOCK,
        start,
        end,
        "`};` is missing before the end of the file",
        notes=(Note(situation.source.span(opened.start, opened.end), "it is opened here"),),
    )


def stray_text(first: Token, last: Token, harmless: bool) -> Repair:
    """The finding about everything from `first` to `last`, behind the end."""
    return Repair(
        codes.STRAY_TEXT if harmless else codes.TEXT_BEHIND_END,
        first.start,
        last.end if harmless else first.end,
        "this stands behind the end and is ignored"
        if harmless
        else "this stands behind the end, and nothing of it is read",
        help="" if harmless else "a `}` too many before it may have ended the block too early",
        title="delete it" if harmless else "",
        edits=((first.start, last.end, ""),) if harmless else (),
    )


def _progress(situation: Situation, made: Repair) -> int:
    """How many of the next tokens are dealt with, at most `WINDOW`; -1 if it is no correction."""
    kinds = [token.kind for token in made.put]
    if made.keep:
        situation = replace(situation, states=situation.states[: made.keep])
    behind = situation.reach(kinds, made.skip)
    return min(made.skip + behind, WINDOW) if behind >= made.need else -1


def _proposals(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
    """All that could be meant, the likeliest first."""
    accepted = situation.accepted()
    yield from _semicolon(situation)
    yield from _semicolon_earlier(situation, item, keep)
    yield from _keyword(situation, accepted)
    yield from _text(situation, accepted)
    yield from _name(situation, accepted)
    yield from _no_name(situation, accepted)
    yield from _block(situation, [], 0)
    yield from _earlier(situation, item, keep)
    # A word too many is less likely than a sign too few, which loses nothing of what was written.
    if _WORD.fullmatch(situation.ahead[0].text):
        yield from _sign(situation, accepted)
        yield from _surplus(situation)
    else:
        yield from _surplus(situation)
        yield from _other_sign(situation, accepted)
        yield from _sign(situation, accepted)


def _semicolon(situation: Situation) -> Iterator[Repair]:
    """Only the `;` is missing. Where the line or block ends anyway, nothing is in doubt."""
    before, token = situation.before, situation.ahead[0]
    clear = situation.new_line() or before.kind == "RBRACE" or token.kind in ("RBRACE", END)
    yield Repair(
        codes.LEGACY_SEMICOLON if clear else codes.MISSING_SEMICOLON,
        before.end,
        before.end,
        f"`;` is missing behind {quote(before)}",
        title="add `;`",
        edits=((before.end, before.end, ";"),),
        put=(Token("_SEMI", ";", before.end, before.end),),
        need=0 if before.kind == "RBRACE" else 1 if clear else 3,
    )


def _semicolon_earlier(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
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


def _keyword(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A keyword with a slip, or in capitals where case counts."""
    token = situation.ahead[0]
    texts = {situation.tables.texts[k]: k for k in accepted if k in situation.tables.words}
    meant = nearest(token.text, texts) if _WORD.fullmatch(token.text) else None
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


def _text(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
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


def _name(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
    """A name with a sign in it that names cannot have, or with a digit in front."""
    before, token = situation.before, situation.ahead[0]
    goes_on = before.end == token.start and bool(_WORD.fullmatch(before.text))
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


def _no_name(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
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


def _signs(situation: Situation, accepted: list[str]) -> list[tuple[str, str]]:
    """Terminal and text of the punctuation that may come next, what is likely missed first."""
    texts = {situation.tables.texts.get(kind, ""): kind for kind in accepted}
    optional = "_SEMI" in accepted
    return [(texts[t], t) for t in _MISSED if t in texts and not (t == "=" and optional)]


def _other_sign(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
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


def _surplus(situation: Situation) -> Iterator[Repair]:
    """One token too many."""
    token = situation.ahead[0]
    if token.kind in (END, "_SEMI", "RBRACE"):
        return
    stray = token.kind == "STRAY"
    shown = quote(token) if token.text.isprintable() else f"U+{ord(token.text[0]):04X}"
    yield Repair(
        codes.STRAY_CHARACTER if stray else codes.UNEXPECTED,
        token.start,
        token.end,
        message=f"{shown} has no meaning here" if stray else "",
        title=f"delete {shown}",
        edits=((token.start, token.end, ""),),
        skip=1,
        need=0 if stray else 3,
    )


def _sign(situation: Situation, accepted: list[str]) -> Iterator[Repair]:
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
        )


def _earlier(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
    """The slip is at the start of the statement, where its first word was taken for a name."""
    if not 0 < len(item) < WINDOW:
        return
    start = replace(situation, states=situation.states[:keep], ahead=item)
    rest = tuple(item[1:])
    for made in _keyword(start, start.accepted()):
        yield replace(made, put=(*made.put, *rest), skip=0, keep=keep, need=1)
    yield from (replace(made, need=1) for made in _block(start, item, keep))


def _block(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
    """A block was not closed before something that cannot stand in it."""
    token, (start, end) = situation.ahead[0], situation.place()
    if token.kind not in situation.tables.words and token.kind != END:
        return
    ends = tuple(Token(kind, "", start, start) for kind in _CLOSED)
    for depth, opened in enumerate(reversed(situation.opened), start=1):
        yield Repair(
            codes.UNCLOSED_BLOCK,
            start,
            end,
            f"`}};` is missing before {quote(token)}",
            notes=(Note(situation.source.span(opened.start, opened.end), "it is opened here"),),
            title="close the block",
            edits=((start, start, "\n};" * depth if token.kind == END else "};\n" * depth),),
            put=ends * depth + tuple(item),
            keep=keep,
        )
