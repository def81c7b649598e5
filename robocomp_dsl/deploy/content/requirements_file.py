"""Reads the `requirements.txt` of a component.

In: the file beside its CDSL. Out: requirements, or findings at their lines. Options, files and URLs
are not supported: the file lists distributions.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.deploy.content import codes
from robocomp_dsl.deploy.content.packaging_library import InvalidRequirement, Requirement
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, UnreadableSource

FILE_NAME = "requirements.txt"


def read_requirements(folder: Path, report: Report) -> list[tuple[Requirement, int]]:
    """The requirements of a component with their lines; none without the file."""
    path = folder / FILE_NAME
    if not path.is_file():
        return []
    try:
        source = Source.read(path)
    except UnreadableSource as error:
        report.add(codes.DISTRIBUTION, Source(path, "").file_span, str(error))
        return []
    found = []
    for number, line in enumerate(source.text.splitlines(), 1):
        text = line.partition(" #")[0].strip()
        if not text or text.startswith("#"):
            continue
        try:
            found.append((Requirement(text), number))
        except InvalidRequirement:
            span = source.span_at(number, line.index(text) + 1, len(text))
            what = "an option" if text.startswith("-") else "not a requirement"
            message = f"`{text}` is {what}; {FILE_NAME} lists Python packages only"
            help_text = "write NAME or NAME>=VERSION, one on a line"
            report.add(codes.DISTRIBUTION, span, message, help=help_text)
    return found
