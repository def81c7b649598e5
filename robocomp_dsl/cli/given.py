"""The descriptions that a command is to read. In: files and folders. Out: files, each once."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.described import described
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS


def descriptions(given: Sequence[Path]) -> list[Path]:
    """The files, and of folders those that are in them; leaves with 1 where there are none.

    A mistyped folder must not pass for one without mistakes.
    """
    paths = list(dict.fromkeys(path for one in given for path in described(one)))
    if not paths:
        options.complain(f"there are no descriptions in {', '.join(f'`{one}`' for one in given)}")
        sys.exit(FINDINGS)
    return paths
