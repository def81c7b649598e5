"""The way of every language from text to tree.

In: the name of a language, its builder, a source and the report of the run. Out: the file node.
"""

from __future__ import annotations

import re
from typing import Any

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.builder import Builder
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.parser import parse
from robocomp_dsl.syntax.tables import load

_HEADS = {
    "module": ("idsl", "an interface description"),
    "component": ("cdsl", "a component description"),
    "componentparams": ("pdsl", "a parameter description"),
    "deployment": ("ddsl", "a deployment description"),
}
_PAGE = re.compile(
    r"\s*(<!DOCTYPE html\b[^>\n]*>?|<html\b[^>\n]*>?|\d{3}: Not Found)", re.IGNORECASE
)
_HEAD = rf"^[ \t]*({'|'.join(_HEADS)})\s+\w+\s*\{{"


def read(language: str, builder: type[Builder], source: Source, report: Report) -> Any:
    """The file node that `builder` makes of `source`."""
    file, made, own = _parse(language, builder, source)
    other = None if made.has_block else _other_language(language, source)
    page = None if made.has_block else _PAGE.match(source.text)
    if page:
        report.add(
            codes.WRONG_LANGUAGE,
            source.span(*page.span(1)),
            "this is a page of a web server",
            label=f"but the file is called `{source.path.name}`",
            help="download the file itself (`Raw`), not the page that shows it",
        )
    elif other:
        what, start, end = other
        report.add(
            codes.WRONG_LANGUAGE,
            source.span(start, end),
            f"this is {what}",
            label=f"but the file is called `{source.path.name}`",
            help="rename the file, or check which file was meant",
        )
    else:
        report.extend(own)
    return file


def _parse(language: str, builder: type[Builder], source: Source) -> tuple[Any, Builder, Report]:
    """The tree, who made it, and what was found; of an edited text, only what changed is read."""
    memory = source.memory if builder.ITEMS_STAND_ALONE else None
    findings = Findings(source, Report())
    made = builder(findings)
    if memory is None:
        return parse(load(language), made, findings), made, findings.report
    from robocomp_dsl.syntax.reuse import Reuse  # noqa: PLC0415 - only an editor needs it

    reuse = Reuse(memory.get(language), findings)
    file = parse(load(language), made, findings, reuse)
    if reuse.jumped and findings.crowded:
        del memory[language]
        return _parse(language, builder, source)
    memory[language] = reuse.memory()
    return file, made, findings.report


def _other_language(language: str, source: Source) -> tuple[str, int, int] | None:
    """What the file describes instead, and where that is seen."""
    for head in re.finditer(_HEAD, source.text, re.MULTILINE | re.IGNORECASE):
        other, what = _HEADS[head[1].lower()]
        if other != language:
            return what, head.start(1), head.end()
    return None
