"""The migration report: `MIGRATION.md`.

In: the findings and the list of converted files. Out: the text of the file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.generate.literals import markdown_cell, markdown_code
from robocomp_dsl.generate.templates import render

FILE = "MIGRATION.md"
_HEADS = {
    Severity.ERROR: ("Not migrated", "This is missing in the new component."),
    Severity.WARNING: ("To review", "This was migrated, but may behave differently."),
    Severity.NOTE: ("For information", "No action is needed."),
}
_ABOUT_CODE = """## How the old code runs now

- Methods are unchanged. Proxies have their old names (`self.laser_proxy`), and so have the
  methods that other components call (`Laser_getLaserData`).
- `legacy.py` provides everything else that the code expects: `Ice`, `ifaces`, `RoboComp…` modules,
  a `timer` that does nothing. It calls the old `__init__(proxy_map, …)` and then
  `setParams(params)` from `initialize`, when the proxies are connected; `params` has the old keys.
- A call that fails raises an exception of `robocomp_dsl.runtime.errors`; `except Ice.Exception`
  catches it.
- New code uses `initialize()`, `self.params.<name>` and types of the module `interfaces` of the
  generated package. When no old name is in use any more, delete `legacy.py`.
"""


def report_text(
    name: str,
    converted_files: Sequence[tuple[str, str]],
    findings: Iterable[Diagnostic],
    format_path: Callable[[Path], str],
    next_steps: Sequence[str],
    *,
    has_legacy_code: bool = False,
) -> str:
    """The report. `converted_files` has old and new names; `format_path` formats a path."""
    all_findings = list(findings)
    parts = [f"# Migration of {name}", "Written by `rcgen migrate`; delete it when done."]
    parts.append(render("install.md.jinja").strip())
    parts.append("## Next\n\n" + "\n".join(f"    {step}" for step in next_steps))
    for severity, (head, about) in _HEADS.items():
        items = [_list_item(f, format_path) for f in all_findings if f.severity is severity]
        if items:
            listed = "\n".join(items)
            parts.append(f"## {head}\n\n{about} See `rcgen explain CODE`.\n\n{listed}")
    if not any(finding.severity is Severity.ERROR for finding in all_findings):
        parts.append("Everything was migrated.")
    table = [f"| {markdown_code(old)} | {markdown_code(new)} |" for old, new in converted_files]
    parts.append("\n".join(["## Converted files\n", "| old | new |", "|---|---|", *table]))
    if has_legacy_code:
        parts.append(_ABOUT_CODE.rstrip())
    return "\n\n".join(parts) + "\n"


def _list_item(finding: Diagnostic, format_path: Callable[[Path], str]) -> str:
    source = finding.span.source
    place = format_path(source.path)
    if source.text:
        place += f":{finding.span.start_position[0]}"
    return f"- {markdown_code(place)} {_inline(finding.message)} ({finding.code.id})"


def _inline(message: str) -> str:
    """A message as Markdown: text in backquotes becomes code, the rest plain text."""
    parts = message.split("`")
    if len(parts) % 2 == 0:
        return markdown_cell(message)
    return "".join(
        markdown_code(part) if number % 2 else _plain(part) for number, part in enumerate(parts)
    )


def _plain(part: str) -> str:
    """Escaped text that keeps its leading and trailing space."""
    body = markdown_cell(part)
    before = " " if part[:1].isspace() else ""
    after = " " if part[-1:].isspace() and body else ""
    return f"{before}{body}{after}"
