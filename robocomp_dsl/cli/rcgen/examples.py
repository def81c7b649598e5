"""`rcgen examples`: lists the shipped examples. Out: a table of names, kinds, descriptions."""

from __future__ import annotations

import click

from robocomp_dsl.cli.rcgen.shipped import examples


@click.command()
def command() -> None:
    """List the components, robots and demos that ship; `rcgen new NAME --example X` copies one."""
    known = examples().values()
    name, kind = (max(len(getattr(example, key)) for example in known) for key in ("name", "kind"))
    for example in known:
        print(f"{example.name:<{name}}  {example.kind:<{kind}}  {example.about}")
