"""Writes a generated component to disk, for commands that generate one from a world."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write


def write_component(folder: Path, files: Sequence[OutputFile], ports: int, next_step: str) -> None:
    """Write `files` and print a summary and the next step. Raises `CliError` if that fails."""
    try:
        changes = write(folder, files)
    except CannotWrite as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    written = sum(change.pending for change in changes)
    print(f"{folder}: {written} of {len(changes)} files written; {ports} ports")
    print(f"next: {next_step}")
