"""Reads the INI syntax of yarp-bottle-generator, with positions.

In: a source. Out: `IniSection`s, and findings for lines that are none. Blanks around names and
values do not count; a line that starts with `;` or `#` is a comment; quotes belong to the value.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.source import Source, Span


@dataclass(frozen=True, slots=True)
class IniValue:
    """A value as written; `span` covers it, `key_span` its key."""

    text: str
    span: Span
    key_span: Span


@dataclass(slots=True)
class IniSection:
    """`[name]` and its entries; `span` covers the name."""

    name: str
    span: Span
    entries: dict[str, IniValue] = field(default_factory=dict)


def read_ini(source: Source, report: Report) -> dict[str, IniSection]:
    """The sections by name."""
    sections: dict[str, IniSection] = {}
    section: IniSection | None = None
    for number, start in enumerate(source.line_starts, 1):
        line = source.line(number)
        text = line.strip()
        if not text or text[0] in ";#":
            continue
        begin = start + len(line) - len(line.lstrip())
        span = source.span(begin, begin + len(text))
        if text.startswith("["):
            section = _section(text, span, sections, report)
        elif section is None:
            help_ = "start the file with `[general]`"
            report.add(codes.INVALID_LINE, span, "a line before the first section", help=help_)
        else:
            _entry(text, span, section, report)
    return sections


def _section(
    text: str, span: Span, sections: dict[str, IniSection], report: Report
) -> IniSection | None:
    name = text[1:-1].strip()
    if not text.endswith("]") or not name:
        help_ = "write `[general]`, `[mux1]`, `[message]` or the name of a nested message"
        report.add(codes.INVALID_LINE, span, "expected `[name]`", help=help_)
        return IniSection(name, span)
    earlier = sections.get(name)
    if earlier is not None:
        report.add(
            codes.INVALID_LINE,
            span,
            f"the section `[{name}]` appears twice",
            notes=(Note(earlier.span, "the first one is here"),),
            help="give one of them another name, or delete it",
        )
        return IniSection(name, span)
    section = sections[name] = IniSection(name, span)
    return section


def _entry(text: str, span: Span, section: IniSection, report: Report) -> None:
    written, equals, value = text.partition("=")
    key = written.strip()
    if not equals or not key:
        message = f"expected `key = value`, found `{text:.40}`"
        report.add(codes.INVALID_LINE, span, message, help="start a comment with `;`")
        return
    key_span = span.subspan(span.start, span.start + len(key))
    shown = value.strip()
    begin = span.end - len(value.lstrip()) if shown else span.end
    entry = IniValue(shown, span.subspan(begin, begin + len(shown)), key_span)
    if key in section.entries:
        report.add(
            codes.INVALID_LINE,
            key_span,
            f"`{key}` appears twice in `[{section.name}]`",
            notes=(Note(section.entries[key].key_span, "the first one is here"),),
            help="delete one of them",
        )
        return
    section.entries[key] = entry
