"""The click commands of this project as attributes, for the directive of sphinx-click.

`rcgen__config__list` is the command `rcgen config list`. The programs load their sub-commands
lazily, and none of them knows its own name.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import click

PYPROJECT = Path(__file__).parents[2] / "pyproject.toml"
SEPARATOR = "__"


def __getattr__(name: str) -> click.Command:
    # The import system asks for names such as `__path__`, too; no command has to be loaded for it.
    found = {} if name.startswith("_") else dict(commands())
    if name not in found:
        raise AttributeError(name)
    return found[name]


def commands() -> Iterator[tuple[str, click.Command]]:
    """Every installed command and all its sub-commands, by attribute name."""
    scripts = tomllib.loads(PYPROJECT.read_text(encoding="utf-8"))["project"]["scripts"]
    for name, entry in scripts.items():
        values = vars(import_module(entry.partition(":")[0])).values()
        program = next(value for value in values if isinstance(value, click.Group))
        yield from _below(name, program)


def _below(name: str, command: click.Command) -> Iterator[tuple[str, click.Command]]:
    yield name, command
    if isinstance(command, click.Group):
        context = click.Context(command)
        for below in command.list_commands(context):
            loaded = command.get_command(context, below)
            if loaded is not None:
                yield from _below(f"{name}{SEPARATOR}{below}", loaded)
