"""Reports imports of ROS definitions that cannot be resolved.

In: a statement and the definitions that exist. Out: a diagnostic with the nearest names and where
was searched.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.import_resolver import ImportResolver
from robocomp_dsl.check.workspace.ros_definitions import canonical_name, is_ros_import
from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.syntax.ast.base import Import

_MOST_FOLDERS = 6


def report_missing_definition(
    statement: Import, root: Path, search: ImportResolver, report: Report
) -> None:
    """Report a definition that is in none of the folders."""
    written, span = statement.path.value, statement.path.span
    beside = span.source.path
    guesses = search.ros.suggest(written, beside, root)
    folders = [str(folder) for folder in search.ros.search_path(beside, root)]
    searched = join_names(folders, most=_MOST_FOLDERS)
    name = canonical_name(written)
    help_ = (
        f"looked in {searched} and {_store()}; `-I`, AMENT_PREFIX_PATH and ROS_PACKAGE_PATH add "
        "folders, which contain packages such as `std_msgs/msg/String.msg`"
    )
    if not name:
        help_ = "the path of a ROS definition has its package: `std_msgs/msg/String.msg`"
    is_type = is_ros_import(beside.name)
    fix = None
    if len(guesses) == 1 and not is_type:
        fix = Fix(f'change to `"{guesses[0]}"`', (Edit(span, f'"{guesses[0]}"'),))
    report.add(
        codes.MISSING_ROS_DEFINITION,
        span,
        f"cannot find the ROS definition `{name or written}`",
        label=f"did you mean {join_names(guesses, most=3)}?" if guesses else "",
        help=help_,
        fix=fix,
    )


def report_definition_in_component(statement: Import, report: Report) -> None:
    """Report a definition that a component imports: it declares no interface."""
    report.add(
        codes.NOT_IMPORTABLE,
        statement.path.span,
        f"`{statement.path.value}` declares types, but a component imports interfaces",
        help="import it in the IDSL file whose operations use the type",
        fix=Fix("remove the import", (Edit(statement.span, ""),)),
    )


def _store() -> str:
    from robocomp_dsl.check.workspace import ros_store  # noqa: PLC0415 - loads rosbags

    if ros_store.is_available():
        return f"the messages of ROS 2 {ros_store.DISTRIBUTION.capitalize()} in rosbags"
    return "not in rosbags, which is not installed (`pip install robocomp_dsl[ros]`)"
