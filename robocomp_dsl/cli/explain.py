"""`rcgen explain`: what a code means. In: a code or nothing. Out: its explanation, or the list."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pkgutil import iter_modules

import click

from robocomp_dsl.diagnostics import Code, nearest

STAGES = ("syntax", "check", "generate", "compare", "deploy", "migrate")
"""Those that find something; the kinds of it are in modules called `codes…`."""


def all_codes() -> dict[str, Code]:
    """Every kind of finding, by its id, in order."""
    return {code.id: code for code in sorted(_codes(), key=lambda c: c.id)}


def _codes() -> Iterator[Code]:
    for stage in STAGES:
        package = import_module(f"robocomp_dsl.{stage}")
        for module in iter_modules(package.__path__):
            if module.name.startswith("codes"):
                found = vars(import_module(f"{package.__name__}.{module.name}")).values()
                yield from (value for value in found if isinstance(value, Code))


@click.command()
@click.argument("code", required=False)
def command(code: str | None) -> None:
    """Say what a code such as RC204 means, and how to mend it; without CODE, list all."""
    known = all_codes()
    if code is None:
        for one in known.values():
            print(f"{one.id}  {one.severity:<7}  {one.title}")
        return
    found = known.get(code.upper())
    if found is None:
        guess = nearest(code.upper(), known)
        hint = f"did you mean `{guess}`?" if guess else "`rcgen explain` lists all"
        raise click.UsageError(f"there is no code `{code}`; {hint}")
    print(f"{found.id} ({found.severity}): {found.title}\n\n{found.explanation.strip()}")
