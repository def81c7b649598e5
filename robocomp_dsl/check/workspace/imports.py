"""Import statements: finds the imported file or reports where it was searched.

In: a statement and the file that contains it. Out: an existing path, or None and a diagnostic.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.workspace.import_resolver import SUFFIX, ImportResolver, base_name
from robocomp_dsl.check.workspace.ros_definitions import canonical_name, is_ros_import
from robocomp_dsl.check.workspace.ros_imports import (
    report_definition_in_component,
    report_missing_definition,
)
from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.check.workspace.yarp_definitions import declares_types_only, is_yarp_import
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Import

_SLICE = "ice"
_COMPONENT = ".cdsl"

CycleStep = tuple[str, Import]
"""A file and the statement that imports the next file of the cycle."""


def locate_import(statement: Import, root: Path, search: ImportResolver) -> Path | None:
    """The file of an import in the checked file `root`, or None."""
    written = statement.path.value
    if is_ros_import(written):
        return search.ros.find(written, statement.path.span.source.path, root)
    if is_yarp_import(written):
        return search.yarp.find(written, statement.path.span.source.path, root)
    name = _idsl_name(statement.path.value)
    beside = statement.path.span.source.path
    return search.find(name, root, beside) if name.lower().endswith(SUFFIX) else None


def find_import(
    statement: Import, root: Path, search: ImportResolver, report: Report
) -> Path | None:
    """As `locate`; a missing file is reported."""
    found = locate_import(statement, root, search)
    name = base_name(statement.path.value)
    is_component = statement.span.source.path.suffix.lower() == _COMPONENT
    if is_component and (is_ros_import(name) or declares_types_only(name)):
        report_definition_in_component(statement, report)
    elif is_ros_import(name):
        if found is None:
            report_missing_definition(statement, root, search, report)
    elif is_yarp_import(name):
        if found is None:
            search.yarp.report_missing(statement, root, report)
    elif found is None:
        if name.lower().endswith(SUFFIX):
            _report_missing(name, statement, root, search, report)
        else:
            _report_no_idsl(name, statement, report)
    elif _idsl_name(name) != name:
        _report_other_suffix(name, statement, report)
    return found


def report_duplicate_imports(
    statements: Sequence[Import], files: Sequence[Path | None], report: Report
) -> None:
    """Report files that are imported twice; `files` are those that the statements mean."""
    first: dict[str, Import] = {}
    for statement, file in zip(statements, files, strict=True):
        written = statement.path.value
        key = canonical_name(written) if is_ros_import(written) else ""
        found = canonical_path(file) if file else base_name(written)
        earlier = first.setdefault(key or found, statement)
        if earlier is not statement:
            report.add(
                codes.DUPLICATE_IMPORT,
                statement.path.span,
                f"`{base_name(statement.path.value)}` is imported twice",
                notes=[Note(earlier.path.span, "first imported here")],
                fix=Fix("remove the second import", (Edit(statement.span, ""),)),
            )


def report_cycle(steps: Sequence[CycleStep], report: Report) -> None:
    """Report files that import each other.

    The same cycle gives the same finding whichever of its files was read first.
    """
    start = min(range(len(steps)), key=lambda i: steps[i][0])
    turned = [*steps[start:], *steps[:start]]
    names = [Path(file).name for file, _ in turned]
    if len(names) == 1:
        statement = turned[0][1]
        report.add(
            codes.IMPORT_CYCLE,
            statement.path.span,
            f"`{names[0]}` imports itself",
            fix=Fix("remove the import", (Edit(statement.span, ""),)),
        )
        return
    chain = " → ".join(f"`{name}`" for name in (*names, names[0]))
    links = list(zip(turned, (*names[1:], names[0]), strict=True))
    report.add(
        codes.IMPORT_CYCLE,
        turned[0][1].path.span,
        f"`{names[0]}` imports itself: {chain}",
        notes=[Note(s.path.span, f"`{name}` is imported here") for (_, s), name in links[1:]],
        help="move the common declarations to a third file, and import that from both",
    )


def replace_fix(span: Span, text: str) -> Fix:
    """A fix that replaces `span` by `text`."""
    return Fix(f"change to `{text}`", (Edit(span, text),))


def _idsl_name(name: str) -> str:
    """The IDSL file of `name`: RoboComp generates `X.ice` from `X.idsl`; some imports say `X`."""
    if name and "." not in base_name(name):
        return name + SUFFIX
    stem, dot, suffix = name.rpartition(".")
    return stem + SUFFIX if dot and suffix.lower() == _SLICE else name


def _report_other_suffix(name: str, statement: Import, report: Report) -> None:
    reason = "is generated for Ice" if name.lower().endswith(f".{_SLICE}") else "has no suffix"
    report.add(
        codes.OTHER_SUFFIX,
        statement.path.span,
        f"`{name}` {reason}; the import uses `{_idsl_name(name)}`",
        fix=replace_fix(statement.path.span, f'"{_idsl_name(name)}"'),
    )


def _report_missing(
    name: str, statement: Import, root: Path, search: ImportResolver, report: Report
) -> None:
    guess = search.suggest(name, root)
    place, written = statement.path.span, statement.path.value
    folders = search.search_path(root, place.source.path)
    looked = ", ".join(str(folder) for folder in folders)
    outside = "" if name == written else f"`{written}` and then `{name}` in "
    option = "" if place.text.startswith('"') else f", which the option `{place.text}` imports"
    report.add(
        codes.MISSING_IMPORT,
        place,
        f"cannot find `{name}`{option}",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"looked for {outside}{looked}; `-I` and ROBOCOMP_INTERFACES add folders"
        if outside
        else f"looked in {looked}; `-I` and ROBOCOMP_INTERFACES add folders",
        fix=replace_fix(statement.path.span, f'"{guess}"') if guess else None,
    )


def _report_no_idsl(name: str, statement: Import, report: Report) -> None:
    report.add(
        codes.NOT_IMPORTABLE,
        statement.path.span,
        f"`{statement.path.value}` is not an `{SUFFIX}` file" if name else "no file is named here",
        help=f"an import names an interface description, such as `Laser{SUFFIX}`",
    )
