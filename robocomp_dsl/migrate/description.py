"""The CDSL file of the new component: today's form, its parameters and its period.

In: the old text. Out: the new text. Legacy forms are rewritten as `rcgen check --fix` does.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check import check_file
from robocomp_dsl.check.fixes import fix_all
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import ast_cdsl, parse_cdsl


def modern(path: Path, workspace: Workspace) -> str:
    """The text of a description in today's form. Raises `UnreadableSource`."""
    source = workspace.files.read(path)

    def judge(text: str) -> tuple[Source, list[Diagnostic]]:
        buffer = workspace.files.open_buffer(path, text)
        report = Report()
        check_file(path, workspace, report)
        return buffer, report.sorted()

    try:
        return fix_all(source, judge).text
    finally:
        workspace.files.close_buffer(path)


def tree_of(path: Path, text: str) -> ast_cdsl.Component | None:
    """The component that a text describes, if there is one to be seen."""
    return parse_cdsl(Source(path, text), Report()).component


def completed(path: Path, text: str, parameters: str, period: int | None) -> str:
    """The text with `language Python`, the name of the PDSL file and the period, where they lack.

    `parameters` is empty for a component without any.
    """
    tree = tree_of(path, text)
    if tree is None:
        return text
    added = []
    if tree.language is None:
        added.append("language Python;")
    if parameters and tree.parameters is None:
        added.append(f'parameters "{parameters}";')
    if period is not None and tree.period is None:
        added.append(f"period {period};")
    text = _inserted(text, tree, added)
    if tree.language is not None and tree.language.text.lower() != "python":
        span = tree.language.span
        end = span.end + len(text[span.end :]) - len(text[span.end :].lstrip("+"))
        return f"{text[: span.start]}Python{text[end:]}"
    return text


def _inserted(text: str, tree: ast_cdsl.Component, added: list[str]) -> str:
    """The statements in front of the brace that ends the component."""
    brace = text.rfind("}", tree.span.start, tree.span.end)
    if not added or brace < 0:
        return text
    line_end = "\r\n" if "\r\n" in text else "\n"
    before = text[:brace].rstrip(" \t")
    begin = "" if before.endswith("\n") else line_end
    rows = "".join(f"    {one}{line_end}" for one in added)
    return f"{before}{begin}{rows}{text[brace:]}"
