"""Import statements: from what is written to a file, or to a finding that says where it was sought.

In: a statement and the file it stands in. Out: a path that exists, or None and a finding.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check import codes
from robocomp_dsl.check.search import SUFFIX, Search, base_name
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast_base import Import

_SLICE = "ice"

Step = tuple[str, Import]
"""A file, by its name in messages, and the statement through which it imports the next one."""


def locate(statement: Import, root: Path, search: Search) -> Path | None:
    """The IDSL file that an import in the checked file `root` means, or None."""
    name = _meant(base_name(statement.path.value))
    return search.find(name, root) if name.lower().endswith(SUFFIX) else None


def find_import(statement: Import, root: Path, search: Search, report: Report) -> Path | None:
    """As `locate`; an import that leads nowhere is reported."""
    found = locate(statement, root, search)
    name = base_name(statement.path.value)
    if found is None:
        if name.lower().endswith(SUFFIX):
            _report_missing(name, statement, root, search, report)
        else:
            _report_no_idsl(name, statement, root, search, report)
    elif _meant(name) != name:
        _report_slice(name, statement, report)
    return found


def report_repeated(statements: Sequence[Import], report: Report) -> None:
    """Warn of files that are imported twice."""
    first: dict[str, Import] = {}
    for one in statements:
        earlier = first.setdefault(base_name(one.path.value), one)
        if earlier is not one:
            report.add(
                codes.REPEATED_IMPORT,
                one.path.span,
                f"`{base_name(one.path.value)}` is imported twice",
                notes=[Note(earlier.path.span, "first imported here")],
                fix=Fix("remove the second import", (Edit(one.span, ""),)),
            )


def report_cycle(steps: Sequence[Step], report: Report) -> None:
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
        help="move what both need into a third file, and import that from both",
    )


def replace(span: Span, text: str) -> Fix:
    """The fix for a name that was meant otherwise."""
    return Fix(f"change to `{text}`", (Edit(span, text),))


def _meant(name: str) -> str:
    """The file that `name` means: RoboComp writes the one `.ice` of an interface from its IDSL."""
    stem, dot, suffix = name.rpartition(".")
    return stem + SUFFIX if dot and suffix.lower() == _SLICE else name


def _report_slice(name: str, statement: Import, report: Report) -> None:
    report.add(
        codes.SLICE_IMPORT,
        statement.path.span,
        f"`{name}` is the file that Ice reads; `{_meant(name)}` is taken",
        fix=replace(statement.path.span, f'"{_meant(name)}"'),
    )


def _report_missing(
    name: str, statement: Import, root: Path, search: Search, report: Report
) -> None:
    guess = search.guess(name, root)
    looked = ", ".join(str(folder) for folder in search.folders(root))
    written = statement.path.value
    outside = "" if name == written else f"; only the last part, `{name}`, is looked for"
    place = statement.path.span
    option = "" if place.text.startswith('"') else f", which the option `{place.text}` imports"
    report.add(
        codes.MISSING_IMPORT,
        place,
        f"cannot find `{name}`{option}",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"looked in {looked}{outside}; `-I` and ROBOCOMP_INTERFACES add folders",
        fix=replace(statement.path.span, f'"{guess}"') if guess else None,
    )


def _report_no_idsl(
    name: str, statement: Import, root: Path, search: Search, report: Report
) -> None:
    with_suffix = f"{name}{SUFFIX}"
    guess = with_suffix if search.find(with_suffix, root) else None
    report.add(
        codes.NOT_IMPORTABLE,
        statement.path.span,
        f"`{statement.path.value}` is not an `{SUFFIX}` file" if name else "no file is named here",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"an import names an interface description, such as `Laser{SUFFIX}`; it is looked for "
        "beside the file and in the interface folders only, wherever the written path leads",
        fix=replace(statement.path.span, f'"{guess}"') if guess else None,
    )
