"""Suggests the missing import of a name that no imported file declares.

In: the name and the file that uses it. Out: the files that could be imported, and the edit.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.import_resolver import ImportResolver
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.diagnostics import Edit, Fix
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.syntax.ast.base import Import, QualifiedName
from robocomp_dsl.syntax.definitions import YARP_SUFFIXES
from robocomp_dsl.syntax.parse import parse_idsl
from robocomp_dsl.syntax.ros.kinds import ROS_PARTS

ROS_PACKAGE = re.compile(r"[a-z][a-z0-9_]*")
"""The name of a ROS package; IDSL modules usually begin with a capital letter."""


class ImportSuggestion(ValueRecord):
    """Files that declare a name, and the edit that imports the only one."""

    paths: tuple[Path, ...]
    fix: Fix | None
    written: str = ""
    """What to import, if it is a definition of ROS: its path says nothing to the user."""

    @property
    def help(self) -> str:
        """The help text."""
        if self.written:
            return f'add `import "{self.written}";`'
        verb = "declares" if len(self.paths) == 1 else "declare"
        return f"{join_names([str(path) for path in self.paths], most=3)} {verb} it"

    @property
    def is_not(self) -> str:
        """The verb phrase after `help` and "but"."""
        return "is not" if len(self.paths) == 1 else "none is"


def suggest_import(
    name: QualifiedName,
    source: Source,
    imports: Sequence[Import],
    files: SourceCache,
    search: ImportResolver,
) -> ImportSuggestion | None:
    """The files that declare `name`, or None; with an edit if there is exactly one."""
    seen = search.files_mentioning(name.name.text, source.path)
    found = [path for path in seen if path != source.path and _declares(path, name, files)]
    if not found:
        return _suggest_ros(name, source, imports, search) or _suggest_yarp(
            name, source, imports, search
        )
    fix = add_import(found[0].name, source, imports) if len(found) == 1 else None
    return ImportSuggestion(tuple(found), fix)


def _suggest_ros(
    name: QualifiedName, source: Source, imports: Sequence[Import], search: ImportResolver
) -> ImportSuggestion | None:
    """The ROS definition of `sensor_msgs::LaserScan` or `std_srvs::SetBool_Request`."""
    if name.module is None or ROS_PACKAGE.fullmatch(name.module.text) is None:
        return None
    stem, _, part = name.name.text.rpartition("_")
    for suffix, parts in ROS_PARTS.items():
        plain = stem if f"_{part}" in parts else name.name.text if "" in parts else ""
        written = f"{name.module.text}/{suffix[1:]}/{plain}{suffix}"
        path = search.ros.find(written, source.path, source.path) if plain else None
        if path is not None:
            return ImportSuggestion((path,), add_import(written, source, imports), written)
    return None


def _suggest_yarp(
    name: QualifiedName, source: Source, imports: Sequence[Import], search: ImportResolver
) -> ImportSuggestion | None:
    """The YARP definition of `motor::Status`: the file with the name of the module."""
    written = {statement.path.value for statement in imports}
    for suffix in YARP_SUFFIXES if name.module else ():
        file = f"{name.module.text}{suffix}" if name.module else ""
        path = search.yarp.find(file, source.path, source.path)
        if path is not None and file not in written:
            return ImportSuggestion((path,), add_import(file, source, imports))
    return None


def add_import(file: str, source: Source, imports: Sequence[Import]) -> Fix:
    """The edit that imports `file`, after the other imports or at the top."""
    statement = f'import "{file}";'
    if imports:
        end = imports[-1].span.end
        edit = Edit(source.span(end, end), f"\n{statement}")
    else:
        edit = Edit(source.file_span, f"{statement}\n")
    return Fix(f"add `{statement}`", (edit,))


def _declares(path: Path, name: QualifiedName, files: SourceCache) -> bool:
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
