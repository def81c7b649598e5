"""The CDSL file of the new component: current syntax, parameters and period.

In: the old text. Out: the new text. Outdated syntax is rewritten as `rcgen check --fix` does.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.fixes import fix_all
from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import cdsl
from robocomp_dsl.syntax.parse import parse_cdsl


def upgrade_syntax(path: Path, workspace: Workspace) -> str:
    """The text of a description in the current syntax. Raises `UnreadableSource`."""
    source = workspace.sources.read(path)

    def check(text: str) -> tuple[Source, list[Diagnostic]]:
        buffer = workspace.sources.set_overlay(path, text)
        report = Report()
        check_file(path, workspace, report)
        return buffer, report.sorted()

    try:
        return fix_all(source, check).text
    finally:
        workspace.sources.remove_overlay(path)


def parse_component(path: Path, text: str) -> cdsl.Component | None:
    """The syntax tree of the component that a text describes; None if it describes none."""
    return parse_cdsl(Source(path, text), Report()).component


def complete_description(path: Path, text: str, parameters: str, period: int | None) -> str:
    """The text with `language Python`, the name of the PDSL file and the period added if missing.

    `parameters` is the name of the PDSL file; empty for a component without parameters.
    """
    tree = parse_component(path, text)
    if tree is None:
        return text
    added = []
    if tree.language is None:
        added.append("language Python;")
    if parameters and tree.parameters is None:
        added.append(f'parameters "{parameters}";')
    if period is not None and tree.period is None:
        added.append(f"period {period};")
    text = _insert_statements(text, tree, added)
    if tree.language is not None and tree.language.text.lower() != "python":
        span = tree.language.span
        end = span.end + len(text[span.end :]) - len(text[span.end :].lstrip("+"))
        return f"{text[: span.start]}Python{text[end:]}"
    return text


def _insert_statements(text: str, tree: cdsl.Component, added: list[str]) -> str:
    """Insert statements before the closing brace of the component."""
    brace = text.rfind("}", tree.span.start, tree.span.end)
    if not added or brace < 0:
        return text
    line_end = "\r\n" if "\r\n" in text else "\n"
    before = text[:brace].rstrip(" \t")
    begin = "" if before.endswith("\n") else line_end
    lines = "".join(f"    {statement}{line_end}" for statement in added)
    return f"{before}{begin}{lines}{text[brace:]}"
