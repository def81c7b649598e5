"""Finds definitions of YARP: `motor.thrift`, `gaze.bottle`.

In: the path in an import and the importing file. Out: an existing file, in this order: relative to
the importing file, to the folder of the checked file, to the import folders, and to the shipped
interfaces; then the last part of the path in the same folders. No import leaves these folders.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.diagnostics import Edit, Fix, Report, nearest
from robocomp_dsl.syntax.ast.base import Import
from robocomp_dsl.syntax.definitions import BOTTLE_SUFFIX, YARP_SUFFIXES


def is_yarp_import(written: str) -> bool:
    """Whether an import names a definition of YARP."""
    return written.lower().endswith(YARP_SUFFIXES)


def declares_types_only(written: str) -> bool:
    """Whether an import names a definition without interfaces."""
    return written.lower().endswith(BOTTLE_SUFFIX)


class YarpDefinitions:
    """The folders of one workspace in which definitions are searched."""

    def __init__(self, files: SourceCache, folders: Iterable[Path]) -> None:
        self._files = files
        self._folders = tuple(folders)

    def search_path(self, beside: Path, root: Path) -> list[Path]:
        """The folders searched for the definitions that the file `beside` imports."""
        return list(dict.fromkeys((beside.parent, root.parent, *self._folders)))

    def find(self, written: str, beside: Path, root: Path) -> Path | None:
        """The file of a definition, or None."""
        for inside in _inside_paths(written):
            for folder in self.search_path(beside, root):
                if self._files.exists(folder / inside):
                    return folder / inside
        return None

    def importable(self, beside: Path, root: Path) -> list[str]:
        """The names of all definitions beside the file and in the folders."""
        folders = self.search_path(beside, root)
        names = (name for folder in folders for name in self._files.names_in(folder))
        return list(dict.fromkeys(n for n in names if is_yarp_import(n) and n != beside.name))

    def report_missing(self, statement: Import, root: Path, report: Report) -> None:
        """Report a definition that is in none of the folders."""
        written, span = statement.path.value, statement.path.span
        beside = span.source.path
        stems = {PurePosixPath(name).stem: name for name in self.importable(beside, root)}
        stem = nearest(PurePosixPath(written).stem, stems)
        guess = stems[stem] if stem else ""
        searched = join_names([str(folder) for folder in self.search_path(beside, root)])
        fix = Fix(f'change to `"{guess}"`', (Edit(span, f'"{guess}"'),)) if guess else None
        report.add(
            codes.MISSING_IMPORT,
            span,
            f"cannot find `{written}`",
            label=f"did you mean `{guess}`?" if guess else "",
            help=f"looked in {searched}; `-I` and ROBOCOMP_INTERFACES add folders",
            fix=fix,
        )


def _inside_paths(written: str) -> list[str]:
    """The path as written if it does not leave its folder, and its last part."""
    path = PurePosixPath(written.replace("\\", "/"))
    leaves = path.is_absolute() or ".." in path.parts
    return list(dict.fromkeys(([] if leaves else [str(path)]) + [path.name]))
