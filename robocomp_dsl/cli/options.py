"""Options and messages that several commands share."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TextIO

import click

from robocomp_dsl.diagnostics import Diagnostic, Severity

FORMATS = ("full", "concise", "json", "github", "sarif")
HUMAN_FORMATS = ("full", "concise")
"""Formats that list only the first findings of a file."""
DOCUMENT_FORMATS = ("json", "sarif")
"""Formats that print a complete document, also without findings."""

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
    help="Also search imported interfaces in DIR; repeatable.",
)
_WRITE_MODES = (
    click.option(
        "--check", is_flag=True, help="Write nothing; exit with 1 if files are out of date."
    ),
    click.option("--diff", is_flag=True, help="Write nothing; show the changes as a diff."),
    click.option(
        "--dry-run", is_flag=True, help="Write nothing; list the files that would be written."
    ),
    click.option("-q", "quiet", is_flag=True, help="Print findings only."),
)
topic_types = click.option(
    "--type",
    "topic_types",
    multiple=True,
    metavar="TOPIC=PACKAGE/TYPE",
    help="The type of a ROS topic of a configuration of yarp-bottle-generator; repeatable.",
)
packages = click.option(
    "--packages",
    multiple=True,
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Resolve package:// URLs in DIR; repeatable.",
)
world_folders = click.option(
    "--files",
    "world_folders",
    multiple=True,
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Search the meshes and pictures of InnerModel worlds in DIR, too; repeatable."
    " ROBOCOMP_FILES has more folders.",
)
output_format = click.option(
    "--format",
    "output_format",
    type=click.Choice(FORMATS),
    default="full",
    show_default=True,
    help="Output format of the findings.",
)

Command = Callable[..., Any]


def use_colours(stream: TextIO) -> bool:
    """Whether to use colours: on a terminal, unless `NO_COLOR` is set (no-color.org)."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return False
    return stream.isatty()


def print_findings(findings: Sequence[Diagnostic], output_format: str, stream: TextIO) -> None:
    """Print findings in one of `FORMATS`; `DOCUMENT_FORMATS` are printed without findings, too."""
    if not findings and output_format not in DOCUMENT_FORMATS:
        return
    from robocomp_dsl.cli.output import formats, render  # noqa: PLC0415 - most runs find nothing

    if output_format == "full":
        text = render.full(findings, colours=use_colours(stream))
    else:
        text = formats.FORMATS[output_format](findings)
    write_text(text, stream)


def write_text(text: str, stream: TextIO) -> None:
    """Write `text`, with escapes for characters that the stream cannot encode."""
    encoding = stream.encoding or "utf-8"
    stream.write(text.encode(encoding, "backslashreplace").decode(encoding))


def summary(findings: Sequence[Diagnostic]) -> str:
    """`2 errors, 1 warning`."""
    counts = {s: sum(d.severity is s for d in findings) for s in Severity}
    parts = [f"{n} {s}{'s' if n != 1 else ''}" for s, n in counts.items() if n]
    return ", ".join(parts) or "no findings"


def print_error(message: str) -> None:
    """Print an error that has no location in a file."""
    from robocomp_dsl.cli.output.render import strip_control_chars  # noqa: PLC0415

    label = "\x1b[1;31merror\x1b[0m" if use_colours(sys.stderr) else "error"
    print(f"{label}: {strip_control_chars(message)}", file=sys.stderr)


def parse_topic_types(written: Sequence[str]) -> dict[str, str]:
    """The types of `--type` by topic. Raises `click.UsageError`."""
    types = {}
    for text in written:
        topic, equals, name = text.partition("=")
        package, _, type_ = name.strip().removesuffix(".msg").replace("/msg/", "/").partition("/")
        if not equals or not topic.startswith("/") or not package.isidentifier() or not type_:
            problem = (
                f"--type {text!r}: write /TOPIC=PACKAGE/TYPE, such as /goal=geometry_msgs/Point"
            )
            raise click.UsageError(problem)
        types[topic.strip()] = f"{package}/{type_}"
    return types


def write_modes(command: Command) -> Command:
    """Add `--check`, `--diff`, `--dry-run` and `-q` to a command that generates files."""
    for option in reversed(_WRITE_MODES):
        command = option(command)
    return command
