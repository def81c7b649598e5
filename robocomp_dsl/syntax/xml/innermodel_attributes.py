"""Parses the attributes of one XML tag.

In: the tokens between the name of a tag and its end. Out: attributes with unique names; duplicates
and other text are reported.
"""

from __future__ import annotations

import re

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast.base import Name, Text
from robocomp_dsl.syntax.ast.innermodel import Attribute
from robocomp_dsl.syntax.codes import xml as codes
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Token

_ENTITIES = {"amp": "&", "lt": "<", "gt": ">", "quot": '"', "apos": "'"}
_REFERENCE = re.compile(r"&(?:(\w+);|#(\d{1,7});|#[xX]([0-9a-fA-F]{1,6});)?")
_PIECES = re.compile(r"([A-Za-z_][\w:.-]*)(\s*=\s*)?")


def token_range(token: Token) -> tuple[int, int]:
    """The start and end offset of a token."""
    return token.start, token.end


def read_attributes(
    tokens: list[Token], source: Source, findings: FileDiagnostics
) -> tuple[Attribute, ...]:
    """The attributes in `tokens`, in document order."""
    attributes: dict[str, Attribute] = {}
    previous_end = -1
    for token in tokens:
        start, end = token_range(token)
        if token.kind != "JUNK":
            attribute = _attribute(token, source, findings)
            if start == previous_end:
                _no_space(attribute, findings)
            _keep(attribute, attributes, findings)
            previous_end = end
    _report_junk([token for token in tokens if token.kind == "JUNK"], source, findings)
    return tuple(attributes.values())


def _no_space(attribute: Attribute, findings: FileDiagnostics) -> None:
    start = attribute.span.start
    findings.add(
        codes.XML_TAG,
        start,
        attribute.name.span.end,
        f"there must be a space before `{attribute.name.text}`",
        fix=findings.fix("add a space", (start, start, " ")),
    )


def _keep(
    attribute: Attribute, attributes: dict[str, Attribute], findings: FileDiagnostics
) -> None:
    first = attributes.setdefault(attribute.name.text, attribute)
    if first is attribute:
        return
    span = attribute.span
    same = first.value.value == attribute.value.value
    findings.add(
        codes.XML_DUPLICATE_SAME_VALUE if same else codes.XML_DUPLICATE,
        span.start,
        span.end,
        f"the attribute `{attribute.name.text}` is repeated",
        label="the same value" if same else f'the first is "{first.value.value:.40}"',
        notes=(Note(first.span, "first value; this one is used"),),
        fix=findings.fix("remove it", (span.start, span.end, "")) if same else None,
    )


def _attribute(token: Token, source: Source, findings: FileDiagnostics) -> Attribute:
    start, end = token_range(token)
    match = _PIECES.match(token.text)
    name = match[1] if match else token.text
    written = token.text[match.end() :] if match else ""
    offset = end - len(written)
    if token.kind == "ATTRIBUTE":
        value = decode_entities(written[1:-1], offset + 1, findings)
    else:
        value = _malformed_value(token, name, written, findings)
    return Attribute(
        source.span(start, end),
        Name(source.span(start, start + len(name)), name),
        Text(source.span(offset, end), value),
    )


def _malformed_value(token: Token, name: str, written: str, findings: FileDiagnostics) -> str:
    """The value of an attribute with missing quotes or without a value; reports it."""
    start, end = token_range(token)
    offset = end - len(written)
    if token.kind == "OPEN_VALUE":
        message = f"the value of `{name}` has no closing quote"
        fix = findings.fix("add the quote", (end, end, written[0]))
        findings.add(codes.XML_TAG, offset, end, message, fix=fix)
        return written[1:]
    if token.kind == "BARE_VALUE":
        message = f"the value of `{name}` needs quotes"
        fix = findings.fix("add quotes", (offset, end, f'"{written}"'))
        findings.add(codes.XML_TAG, offset, end, message, fix=fix)
        return written
    findings.add(codes.XML_TAG, start, end, f"`{name}` has no value", help=f'write `{name}="…"`')
    return ""


def decode_entities(text: str, start: int, findings: FileDiagnostics) -> str:
    """Replace the entities in `text`; `start` is its offset in the source."""

    def replaced(match: re.Match[str]) -> str:
        named, decimal, hexadecimal = match.groups()
        if named in _ENTITIES:
            return _ENTITIES[named]
        number = int(decimal) if decimal else int(hexadecimal or "0", 16)
        if 0 < number < 0xD800 or 0xDFFF < number < 0x110000:
            return chr(number)
        offset = start + match.start()
        message = f"`{match[0]}` is not a valid entity"
        known = "the entities are `&amp;` `&lt;` `&gt;` `&quot;` `&apos;`"
        findings.add(codes.XML_TAG, offset, offset + len(match[0]), message, help=known)
        return match[0]

    return _REFERENCE.sub(replaced, text) if "&" in text else text


def _report_junk(tokens: list[Token], source: Source, findings: FileDiagnostics) -> None:
    """Report characters that are not part of an attribute; adjacent ones as one diagnostic."""
    runs: list[list[int]] = []
    for start, end in map(token_range, tokens):
        if runs and runs[-1][1] == start:
            runs[-1][1] = end
        else:
            runs.append([start, end])
    for start, end in runs:
        message = f"`{source.text[start:end]:.40}` is not allowed in a tag"
        findings.add(codes.XML_TAG, start, end, message)
