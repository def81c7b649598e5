"""Reference pages of the commands, from their click programs.

In: the commands that `pyproject.toml` installs. Out: one page for each, with every sub-command and
option.
"""

from __future__ import annotations

from itertools import groupby
from pathlib import Path

from docs.generators.commands import SEPARATOR, commands

DIRECTIVE = """\
```{{eval-rst}}
.. click:: docs.generators.commands:{attribute}
   :prog: {program}
   :nested: none
```
"""


def write(folder: Path) -> None:
    """Write one page per program into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    names = [name for name, _ in commands()]
    for program, below in groupby(names, key=lambda name: name.split(SEPARATOR)[0]):
        sections = [
            DIRECTIVE.format(attribute=name, program=name.replace(SEPARATOR, " ")) for name in below
        ]
        text = "\n".join([f"# The command {program}\n", *sections])
        (folder / f"{program}.md").write_text(text, encoding="utf-8")
