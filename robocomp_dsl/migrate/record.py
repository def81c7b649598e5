"""What was done, for people: `MIGRATION.md`.

In: the findings and the list of what became what. Out: the text of the file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.generate.literals import markdown_cell, markdown_code

FILE = "MIGRATION.md"
_HEADS = {
    Severity.ERROR: ("Not carried over", "This is missing in the new component."),
    Severity.WARNING: ("To look at", "This was carried over, but may behave otherwise."),
    Severity.NOTE: ("For information", "This needs nothing."),
}
_ABOUT_CODE = """## How the old code runs now

- Methods are as they were. Proxies have their old names (`self.laser_proxy`), and so have the
  methods that others call (`Laser_getLaserData`).
- `legacy.py` gives the rest of what the code expects: `Ice`, `ifaces`, `RoboComp…` modules, a
  `timer` that starts nothing. It calls the old `__init__(proxy_map, …)` and then
  `setParams(params)` from `initialize`, when the proxies are there; `params` has the old keys.
- A call that fails raises an exception of `robocomp_dsl.runtime.errors`; `except Ice.Exception`
  catches it.
- New code uses `initialize()`, `self.params.<name>` and types of `generated.interfaces`. When no
  old names are left, delete `legacy.py`.
"""


def record_text(
    name: str,
    became: Sequence[tuple[str, str]],
    findings: Iterable[Diagnostic],
    shown: Callable[[Path], str],
    next_steps: Sequence[str],
    *,
    code: bool = False,
) -> str:
    """The report. `became` has old and new names; `shown` says how paths are written."""
    found = list(findings)
    parts = [f"# How {name} moved over", "Written by `rcgen migrate`; delete it when it is read."]
    parts.append("## Next\n\n" + "\n".join(f"    {step}" for step in next_steps))
    for severity, (head, about) in _HEADS.items():
        rows = [_row(one, shown) for one in found if one.severity is severity]
        if rows:
            listed = "\n".join(rows)
            parts.append(f"## {head}\n\n{about} `rcgen explain CODE` says more.\n\n{listed}")
    if not any(one.severity is Severity.ERROR for one in found):
        parts.append("Everything was carried over.")
    table = [f"| {markdown_code(old)} | {markdown_code(new)} |" for old, new in became]
    parts.append("\n".join(["## What became what\n", "| old | new |", "|---|---|", *table]))
    if code:
        parts.append(_ABOUT_CODE.rstrip())
    return "\n\n".join(parts) + "\n"


def _row(one: Diagnostic, shown: Callable[[Path], str]) -> str:
    source = one.span.source
    place = shown(source.path)
    if source.text:
        place += f":{one.span.begin[0]}"
    return f"- {markdown_code(place)} {_inline(one.message)} ({one.code.id})"


def _inline(message: str) -> str:
    """A message as Markdown: what it has in backquotes stays code, the rest is plain."""
    parts = message.split("`")
    if len(parts) % 2 == 0:
        return markdown_cell(message)
    return "".join(
        markdown_code(part) if number % 2 else _plain(part) for number, part in enumerate(parts)
    )


def _plain(part: str) -> str:
    """Plain words with the blanks around them."""
    body = markdown_cell(part)
    before = " " if part[:1].isspace() else ""
    after = " " if part[-1:].isspace() and body else ""
    return f"{before}{body}{after}"
