"""Interfaces for tools that know nothing of IDSL: the formats, and what all of them need.

In: the resolved modules of one IDSL file. Out: an `Export`: files, and findings about what could
not keep its name or its shape. Nothing here writes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.model.interface import Module
from robocomp_dsl.record import Value
from robocomp_dsl.source import Span

FORMATS = {
    "slice": "robocomp_dsl.generate.slice",
    "ros2": "robocomp_dsl.generate.ros2",
    "json-schema": "robocomp_dsl.generate.json_schema",
}
"""Formats, and the module of each, which has `files(modules, alone, report)`."""

Writer = Callable[[Sequence[Module], bool, Report], Iterable[OutputFile]]


class Export(Value):
    """What a format makes of a file. With an error among the findings there are no files."""

    files: tuple[OutputFile, ...]
    findings: tuple[Diagnostic, ...]


def export(modules: Sequence[Module], to: str, *, alone: bool = False) -> Export:
    """The `modules` of one file in the format `to`; with what they import, unless `alone`.

    Raises `KeyError` for a format that is not in `FORMATS`.
    """
    write: Writer = import_module(FORMATS[to]).files
    report = Report()
    files = tuple(write(modules, alone, report))
    return Export(() if report.failed else files, tuple(report.sorted()))


def closure(modules: Iterable[Module]) -> tuple[Module, ...]:
    """`modules` and all that they import, each once, imported ones first."""
    return tuple(dict.fromkeys(one for module in modules for one in module.closure()))


def by_file(modules: Iterable[Module]) -> dict[Path, list[Module]]:
    """Modules by the file that they stand in, in order."""
    found: dict[Path, list[Module]] = {}
    for one in modules:
        found.setdefault(one.path, []).append(one)
    return found


class Spelling:
    """The names of one place in a format where names that only differ in `fold` are the same.

    `fit` makes a name fit the rules of the format; a taken name gets a number, from 2 on.
    """

    def __init__(
        self,
        fit: Callable[[str], str],
        fold: Callable[[str], str] = str.lower,
        taken: Iterable[str] = (),
    ) -> None:
        self._fit = fit
        self._fold = fold
        self._taken = {fold(one) for one in taken}

    def claim(self, name: str) -> tuple[str, bool]:
        """A free name for `name`, and whether it had to give way to another one."""
        fitting = self._fit(name)
        found, number = fitting, 1
        while self._fold(found) in self._taken:
            number += 1
            found = self._fit(f"{fitting}{number}")
        self._taken.add(self._fold(found))
        return found, number > 1


def report_renamed(report: Report, span: Span, old: str, new: str, why: str) -> None:
    """Say that `old` is called `new` in the exported files."""
    report.add(codes.RENAMED_IN_EXPORT, span, f"`{old}` is exported as `{new}`: {why}")
