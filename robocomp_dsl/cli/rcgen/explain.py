"""`rcgen explain`: what a code means. In: a code or nothing. Out: its explanation, or the list."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pkgutil import walk_packages

import click

from robocomp_dsl.diagnostics import Code, nearest

STAGES = ("syntax", "check", "generate", "breaking", "deploy", "migrate")
"""Packages that report findings; their codes are in modules whose names begin with `codes`."""


def all_codes() -> dict[str, Code]:
    """Every finding code by its id, sorted."""
    codes = [code for stage in STAGES for code in stage_codes(stage)]
    return {code.id: code for code in sorted(codes, key=lambda code: code.id)}


def stage_codes(stage: str) -> Iterator[Code]:
    """The finding codes of one stage, in the order of its modules."""
    package = import_module(f"robocomp_dsl.{stage}")
    for module in walk_packages(package.__path__, f"{package.__name__}."):
        if ".codes" in module.name:
            values = vars(import_module(module.name)).values()
            yield from (value for value in values if isinstance(value, Code))


@click.command()
@click.argument("code", required=False)
def command(code: str | None) -> None:
    """Explain a finding code such as RC204 and how to fix it; without CODE, list all codes."""
    known = all_codes()
    if code is None:
        for item in known.values():
            print(f"{item.id}  {item.severity:<7}  {item.title}")
        return
    found = known.get(code.upper())
    if found is None:
        guess = nearest(code.upper(), known)
        hint = f"did you mean `{guess}`?" if guess else "`rcgen explain` lists all"
        raise click.UsageError(f"there is no code `{code}`; {hint}")
    print(f"{found.id} ({found.severity}): {found.title}\n\n{found.explanation.strip()}")
