"""Options that several commands share, and what they say to users."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TextIO

import click

from robocomp_dsl.diagnostics import Diagnostic, Severity

FORMATS = ("full", "concise", "json", "github", "sarif")
FOR_PEOPLE = ("full", "concise")
"""Forms that list only the first of very many findings."""
WHOLE = ("json", "sarif")
"""Forms that are one document, also when there is nothing in it."""

files = click.argument(
    "files",
    nargs=-1,
    required=True,
    type=click.Path(readable=False, path_type=Path),
    metavar="FILE…",
)
folders = click.option(
    "-I",
    "folders",
    multiple=True,
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Look for imported interfaces here, too; may be repeated.",
)
packages = click.option(
    "--packages",
    multiple=True,
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Look for package://… here; may be repeated.",
)
output_format = click.option(
    "--format",
    "form",
    type=click.Choice(FORMATS),
    default="full",
    show_default=True,
    help="How findings are written.",
)

Command = Callable[..., Any]


def colours_on(stream: TextIO) -> bool:
    """Whether colours are wanted there: a terminal, and not told otherwise (no-color.org)."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return False
    return stream.isatty()


def show(findings: Sequence[Diagnostic], form: str, stream: TextIO) -> None:
    """Print findings in one of `FORMATS`; a `WHOLE` one is printed even when it is empty."""
    if not findings and form not in WHOLE:
        return
    from robocomp_dsl.cli import formats, render  # noqa: PLC0415 - most runs find nothing

    if form == "full":
        text = render.full(findings, colours=colours_on(stream))
    else:
        text = formats.FORMATS[form](findings)
    write_text(text, stream)


def write_text(text: str, stream: TextIO) -> None:
    """Write `text`; what the encoding of the stream lacks must not end the program."""
    encoding = stream.encoding or "utf-8"
    stream.write(text.encode(encoding, "backslashreplace").decode(encoding))


def summary(findings: Sequence[Diagnostic]) -> str:
    """`2 errors, 1 warning`."""
    counts = {s: sum(d.severity is s for d in findings) for s in Severity}
    parts = [f"{n} {s}{'s' if n != 1 else ''}" for s, n in counts.items() if n]
    return ", ".join(parts) or "no findings"


def complain(message: str) -> None:
    """A line about something that has no place in a file."""
    from robocomp_dsl.cli.render import harmless  # noqa: PLC0415

    label = "\x1b[1;31merror\x1b[0m" if colours_on(sys.stderr) else "error"
    print(f"{label}: {harmless(message)}", file=sys.stderr)
