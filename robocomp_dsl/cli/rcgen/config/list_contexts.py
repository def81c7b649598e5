"""`rcgen config list`: contexts and their files. In: a context, or none for all. Out: a list."""

from __future__ import annotations

import json

import click

from robocomp_dsl.cli.rcgen.config import lookup
from robocomp_dsl.runtime.config import SearchPath, context_names, files_of
from robocomp_dsl.runtime.parameters import saved

Files = dict[str, list[SearchPath]]


@click.command()
@click.argument("context", required=False, type=lookup.CONTEXT)
@lookup.output_format
def command(context: str | None, output_format: str) -> None:
    """List contexts with their files; below each file, the files that it shadows."""
    folders = lookup.folders()
    if context:
        names = [lookup.require_context(context, folders.roots)]
    else:
        names = context_names(folders.roots)
    found = {name: files_of(name, folders.roots) for name in names}
    if output_format == "json":
        print(json.dumps({name: _data(files) for name, files in found.items()}, indent=1))
    elif not found:
        print("there are no contexts; `rcgen config where NAME` lists the folders searched")
    else:
        print("\n".join(line for name, files in found.items() for line in _lines(name, files)))


def _data(files: Files) -> list[dict[str, object]]:
    return [
        {
            "file": name,
            "path": str(place.folder / name),
            "origin": place.root.origin.value,
            "wins": place is places[0],
            "kept_values": saved.is_saved_file(name),
        }
        for name, places in files.items()
        for place in places
    ]


def _lines(context: str, files: Files) -> list[str]:
    width = max((len(name) for name in files), default=0)
    lines = [f"context {context}" if files else f"context {context} (no files)"]
    for name, places in files.items():
        about = ", live values kept by a component" if saved.is_saved_file(name) else ""
        for i, place in enumerate(places):
            message = f"{place.root.origin.value}{about}"
            mark = f"shadowed by {places[0].root.origin.value}: " if i else ""
            where = lookup.display_path(place.folder / name)
            lines.append(f"  {'' if i else name:{width}}  {mark}{where}  ({message})")
    return lines
