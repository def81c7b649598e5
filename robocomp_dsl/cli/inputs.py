"""The input files of a command. In: files and folders. Out: description files, each once."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.workspace.discovery import find_descriptions
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError


def expand_inputs(inputs: Sequence[Path]) -> list[Path]:
    """The files, and the description files in folders. Raises `CliError` if there are none.

    A mistyped folder must not count as a folder without errors.
    """
    paths = list(dict.fromkeys(path for path in inputs for path in find_descriptions(path)))
    if not paths:
        raise CliError(
            EXIT_FINDINGS,
            f"there are no description files in {', '.join(f'`{path}`' for path in inputs)}",
        )
    return paths
