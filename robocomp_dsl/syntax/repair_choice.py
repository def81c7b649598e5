"""The small correction with which a broken text most likely makes sense.

In: the situation of a parser that is stuck. Out: the correction that lets most of the next tokens
fit; or None.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax import repair_signs as signs
from robocomp_dsl.syntax import repair_words as words
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.repair import Repair
from robocomp_dsl.syntax.situation import WINDOW, Situation, quote
from robocomp_dsl.syntax.tables import END

_CLOSED = ("RBRACE", "_SEMI")


def choose(situation: Situation, item: list[Token], keep: int) -> Repair | None:
    """The best correction.

    `item` are the tokens since the start of the statement, which began with `keep` states.
    """
    if situation.nested_module(item):
        return None
    best, best_progress = None, -1
    for made in _proposals(situation, item, keep):
        progress = _progress(situation, made)
        if progress > best_progress:
            best, best_progress = made, progress
    return best


def _progress(situation: Situation, made: Repair) -> int:
    """How many of the next tokens are dealt with, at most `WINDOW`; -1 if it is no correction."""
    kinds = [token.kind for token in made.put]
    if made.keep:
        situation = situation.replaced(states=situation.states[: made.keep])
    behind = situation.reach(kinds, made.skip)
    return min(made.skip + behind, WINDOW) if behind >= made.need else -1


def _proposals(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
    """All that could be meant, the likeliest first."""
    accepted = situation.accepted()
    yield from signs.semicolon(situation)
    yield from signs.hidden(situation)
    yield from signs.semicolon_earlier(situation, item, keep)
    yield from signs.arrow(situation, accepted)
    yield from words.quoted(situation, accepted)
    yield from words.file_of_interface(situation)
    yield from words.keyword(situation, accepted)
    yield from words.bare_text(situation, accepted)
    yield from words.open_bracket(situation, accepted)
    yield from words.type_first(situation, accepted)
    yield from words.bad_name(situation, accepted)
    yield from words.no_name(situation, accepted)
    yield from words.foreign(situation, item, keep)
    yield from _block(situation, [], 0)
    yield from _earlier(situation, item, keep)
    yield from signs.other_bracket(situation, accepted)
    # A word too many is less likely than a sign too few, which loses nothing of what was written.
    if signs.WORD.fullmatch(situation.ahead[0].text):
        yield from signs.missing_sign(situation, accepted)
        yield from signs.surplus(situation)
    else:
        yield from signs.surplus(situation)
        yield from signs.other_sign(situation, accepted)
        yield from signs.missing_sign(situation, accepted)


def _earlier(situation: Situation, item: list[Token], keep: int) -> Iterator[Repair]:
    """The slip is at the start of the statement, where its first word was taken for a name."""
    if not 0 < len(item) < WINDOW:
        return
    start = situation.replaced(states=situation.states[:keep], ahead=item)
    rest = tuple(item[1:])
    for made in words.keyword(start, start.accepted()):
        yield made.replaced(put=(*made.put, *rest), skip=0, keep=keep, need=1)
    yield from (made.replaced(need=1) for made in _block(start, item, keep))


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
