"""The attributes of one XML tag, from tokens to nodes.

In: the tokens between the name of a tag and its end. Out: attributes with unique names, the first
of each; everything else that stands there is reported.
"""

from __future__ import annotations

import re

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import codes_xml as codes
from robocomp_dsl.syntax.ast_base import Name, Text
from robocomp_dsl.syntax.ast_innermodel import Attribute
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Token

_ENTITIES = {"amp": "&", "lt": "<", "gt": ">", "quot": '"', "apos": "'"}
_REFERENCE = re.compile(r"&(?:(\w+);|#(\d{1,7});|#[xX]([0-9a-fA-F]{1,6});)?")
_PIECES = re.compile(r"([A-Za-z_][\w:.-]*)(\s*=\s*)?")


def ends(token: Token) -> tuple[int, int]:
    """Where a token begins and ends."""
    return token.start, token.end


def read_attributes(
    tokens: list[Token], source: Source, findings: Findings
) -> tuple[Attribute, ...]:
    """The attributes in `tokens`, in order of writing."""
    kept: dict[str, Attribute] = {}
    behind = -1
    for token in tokens:
        start, end = ends(token)
        if token.kind != "JUNK":
            made = _attribute(token, source, findings)
            if start == behind:
                _no_space(made, findings)
            _keep(made, kept, findings)
            behind = end
    _junk([token for token in tokens if token.kind == "JUNK"], source, findings)
    return tuple(kept.values())


def _no_space(made: Attribute, findings: Findings) -> None:
    at = made.span.start
    findings.add(
        codes.XML_TAG,
        at,
        made.name.span.end,
        f"there must be a space before `{made.name.text}`",
        fix=findings.fix("add a space", (at, at, " ")),
    )


def _keep(made: Attribute, kept: dict[str, Attribute], findings: Findings) -> None:
    first = kept.setdefault(made.name.text, made)
    if first is made:
        return
    span = made.span
    same = first.value.value == made.value.value
    findings.add(
        codes.XML_REPEATED if same else codes.XML_DUPLICATE,
        span.start,
        span.end,
        f"the attribute `{made.name.text}` is given twice",
        label="the same value again" if same else f'the first is "{first.value.value:.40}"',
        notes=(Note(first.span, "first given here; this one is used"),),
        fix=findings.fix("remove it", (span.start, span.end, "")) if same else None,
    )


def _attribute(token: Token, source: Source, findings: Findings) -> Attribute:
    start, end = ends(token)
    found = _PIECES.match(token.text)
    name = found[1] if found else token.text
    written = token.text[found.end() :] if found else ""
    at = end - len(written)
    if token.kind == "ATTRIBUTE":
        value = decoded(written[1:-1], at + 1, findings)
    else:
        value = _misspelt(token, name, written, findings)
    return Attribute(
        source.span(start, end),
        Name(source.span(start, start + len(name)), name),
        Text(source.span(at, end), value),
    )


def _misspelt(token: Token, name: str, written: str, findings: Findings) -> str:
    """The value that is meant where the quotes are not as they should be."""
    start, end = ends(token)
    at = end - len(written)
    if token.kind == "OPEN_VALUE":
        said = f"the value of `{name}` has no closing quote"
        fix = findings.fix("add the quote", (end, end, written[0]))
        findings.add(codes.XML_TAG, at, end, said, fix=fix)
        return written[1:]
    if token.kind == "BARE_VALUE":
        said = f"the value of `{name}` must stand in quotes"
        fix = findings.fix("add quotes", (at, end, f'"{written}"'))
        findings.add(codes.XML_TAG, at, end, said, fix=fix)
        return written
    findings.add(codes.XML_TAG, start, end, f"`{name}` has no value", help=f'write `{name}="…"`')
    return ""


def decoded(text: str, start: int, findings: Findings) -> str:
    """A text with its entities replaced; `start` is where it stands."""

    def replaced(match: re.Match[str]) -> str:
        named, decimal, hexadecimal = match.groups()
        if named in _ENTITIES:
            return _ENTITIES[named]
        number = int(decimal) if decimal else int(hexadecimal or "0", 16)
        if 0 < number < 0xD800 or 0xDFFF < number < 0x110000:
            return chr(number)
        at = start + match.start()
        said = f"`{match[0]}` stands for no character"
        known = "the entities are `&amp;` `&lt;` `&gt;` `&quot;` `&apos;`"
        findings.add(codes.XML_TAG, at, at + len(match[0]), said, help=known)
        return match[0]

    return _REFERENCE.sub(replaced, text) if "&" in text else text


def _junk(tokens: list[Token], source: Source, findings: Findings) -> None:
    """Characters that belong to nothing; neighbours make one finding."""
    runs: list[list[int]] = []
    for start, end in map(ends, tokens):
        if runs and runs[-1][1] == start:
            runs[-1][1] = end
        else:
            runs.append([start, end])
    for start, end in runs:
        said = f"`{source.text[start:end]:.40}` does not belong into a tag"
        findings.add(codes.XML_TAG, start, end, said)
