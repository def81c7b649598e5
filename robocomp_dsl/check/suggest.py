"""The import that is missing: which file declares a name that nothing imported declares.

In: the name and the file that uses it. Out: the files that could be imported, and the edit.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.files import Files
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.search import Search
from robocomp_dsl.diagnostics import Edit, Fix
from robocomp_dsl.record import Value
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.syntax import parse_idsl
from robocomp_dsl.syntax.ast_base import Import, QualifiedName


class Offer(Value):
    """Files that declare a name, and the edit that imports the only one."""

    paths: tuple[Path, ...]
    fix: Fix | None

    @property
    def help(self) -> str:
        """What to say about it."""
        verb = "declares" if len(self.paths) == 1 else "declare"
        return f"{listing([str(path) for path in self.paths], most=3)} {verb} it"

    @property
    def is_not(self) -> str:
        """What follows `help` and "but"."""
        return "is not" if len(self.paths) == 1 else "none is"


def offer_import(
    name: QualifiedName, source: Source, imports: Sequence[Import], files: Files, search: Search
) -> Offer | None:
    """The files that declare `name`, if there are any; an edit only where there is one."""
    seen = search.mentioning(name.name.text, source.path)
    found = [path for path in seen if path != source.path and _declares(path, name, files)]
    if not found:
        return None
    fix = add_import(found[0].name, source, imports) if len(found) == 1 else None
    return Offer(tuple(found), fix)


def add_import(file: str, source: Source, imports: Sequence[Import]) -> Fix:
    """The edit that imports `file`, behind the other imports or at the top."""
    statement = f'import "{file}";'
    if imports:
        end = imports[-1].span.end
        edit = Edit(source.span(end, end), f"\n{statement}")
    else:
        edit = Edit(source.whole, f"{statement}\n")
    return Fix(f"add `{statement}`", (edit,))


def _declares(path: Path, name: QualifiedName, files: Files) -> bool:
    try:
        tree = files.parse(path, parse_idsl).tree
    except UnreadableSource:
        return False
    return any(
        declaration.name.text == name.name.text
        for module in tree.modules
        if name.module is None or name.module.text == module.name.text
        for declaration in module.declarations
    )
