"""Parses a source of any language with its builder.

In: the name of a language, its builder, a source and the report of the run. Out: the file node.
"""

from __future__ import annotations

import re
from typing import Any

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.codes import file as codes
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.follow_on import about_uncertain_text
from robocomp_dsl.syntax.grammar.parser import parse
from robocomp_dsl.syntax.grammar.tables import load
from robocomp_dsl.syntax.languages.builder import Builder

_HEADS = {
    "module": ("idsl", "an interface description"),
    "component": ("cdsl", "a component description"),
    "componentparams": ("pdsl", "a parameter description"),
    "deployment": ("ddsl", "a deployment description"),
    "bridge": ("bdsl", "a bridge"),
}
_DESCRIPTIONS = dict(_HEADS.values())
_PAGE = re.compile(
    r"\s*(<!DOCTYPE html\b[^>\n]*>?|<html\b[^>\n]*>?|\d{3}: Not Found)", re.IGNORECASE
)
_COMMANDS = {
    "idsl": "`rcgen interface {name}` generates code for interfaces",
    "cdsl": "`rcgen component {name}` generates code for a component",
    "pdsl": 'name it in the CDSL file: `parameters "{name}";`',
    "ddsl": "`rcdeploy check {name}` checks a deployment, and `rcdeploy up {name}` starts it",
    "bdsl": "`rcgen bridge {name}` generates code for a bridge",
}
"""What to do with a file of each language."""
_XML = re.compile(r"\s*(<\?xml\b[^>\n]*>?|<!--|<[A-Za-z][\w.:-]*[^>\n]*>?)")
_HEAD = rf"^[ \t]*({'|'.join(_HEADS)})\s+\w+\s*\{{"


def parse_source(language: str, builder: type[Builder], source: Source, report: Report) -> Any:
    """Parse `source` and return the file node; reports a file in another language."""
    file, tree_builder, own = _parse(language, builder, source)
    other = None if tree_builder.has_block else _other_language(language, source)
    page = None if tree_builder.has_block else _PAGE.match(source.text)
    if page:
        report.add(
            codes.WRONG_LANGUAGE,
            source.span(*page.span(1)),
            "this is an HTML page of a web server",
            label=f"but the file is called `{source.path.name}`",
            help="download the file itself (`Raw`) instead of the page that shows it",
        )
    elif other:
        found, start, end = other
        name = source.path.name
        is_named_so = source.path.suffix.lower() == f".{found}"
        report.add(
            codes.WRONG_LANGUAGE,
            source.span(start, end),
            f"this is {_DESCRIPTIONS[found]}",
            label=f"{_expected(language)} is needed here"
            if is_named_so
            else f"but the file is called `{name}`",
            help=_COMMANDS[found].format(name=name)
            if is_named_so
            else "rename the file, or check that it is the right file",
        )
    elif xml := None if tree_builder.has_block else _XML.match(source.text):
        report.add(
            codes.WRONG_LANGUAGE,
            source.span(*xml.span(1)),
            "this is XML",
            label=f"{_expected(language)} is needed here",
            help="`rcgen check FILE.xml` checks an InnerModel; `rcgen migrate FILE.xml` reads files"
            " of rcmanager, yarpmanager and yarprobotinterface",
        )
    else:
        own.discard(about_uncertain_text(own))
        report.extend(own)
    return file


def _parse(language: str, builder: type[Builder], source: Source) -> tuple[Any, Builder, Report]:
    """The tree, its builder and the diagnostics; an edited text is parsed incrementally."""
    cache = source.parse_cache
    findings = FileDiagnostics(source, Report())
    tree_builder = builder(findings)
    if cache is None:
        return parse(load(language), tree_builder, findings), tree_builder, findings.report
    from robocomp_dsl.syntax.incremental.incremental import IncrementalParse  # noqa: PLC0415 - editor only

    incremental = IncrementalParse(cache.get(language, ()), findings)
    file = parse(load(language), tree_builder, findings, incremental)
    cache[language] = incremental.new_history()
    return file, tree_builder, findings.report


def _expected(language: str) -> str:
    """What a file of a language is, as in "a bridge"."""
    return _DESCRIPTIONS.get(language, "a state machine")


def _other_language(language: str, source: Source) -> tuple[str, int, int] | None:
    """The language of the file, and the range that shows it; None if unknown."""
    for head in re.finditer(_HEAD, source.text, re.MULTILINE | re.IGNORECASE):
        other, _ = _HEADS[head[1].lower()]
        if other != language:
            return other, head.start(1), head.end()
    return None
