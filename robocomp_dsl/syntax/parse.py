"""Parsing: one function per language, from text to syntax tree.

In: a `Source` and a `Report` for diagnostics. Out: a tree, possibly partial; its `complete` is
False if there were syntax errors. A parser is imported on its first call.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, TypeAlias

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.definitions import BOTTLE_SUFFIX, THRIFT_SUFFIX
from robocomp_dsl.syntax.ros.kinds import ROS_SUFFIXES

if TYPE_CHECKING:
    from robocomp_dsl.syntax.ast import bdsl as ast_bdsl
    from robocomp_dsl.syntax.ast import cdsl as ast_cdsl
    from robocomp_dsl.syntax.ast import ddsl as ast_ddsl
    from robocomp_dsl.syntax.ast import idsl as ast_idsl
    from robocomp_dsl.syntax.ast import innermodel as ast_innermodel
    from robocomp_dsl.syntax.ast import pdsl as ast_pdsl
    from robocomp_dsl.syntax.ast import smdsl as ast_smdsl

    AnyFile: TypeAlias = (
        ast_idsl.File
        | ast_cdsl.File
        | ast_pdsl.File
        | ast_ddsl.File
        | ast_smdsl.File
        | ast_bdsl.File
    )


def parse_idsl(source: Source, report: Report) -> ast_idsl.File:
    """The tree of an interface description."""
    from robocomp_dsl.syntax.languages import idsl  # noqa: PLC0415 - loaded on first use

    return idsl.parse(source, report)


def parse_ros(source: Source, report: Report) -> ast_idsl.File:
    """The tree of a ROS definition: `.msg`, `.srv` or `.action`."""
    from robocomp_dsl.syntax.ros import definition  # noqa: PLC0415 - loaded on first use

    return definition.parse(source, report)


def parse_thrift(source: Source, report: Report) -> ast_idsl.File:
    """The tree of a Thrift definition."""
    from robocomp_dsl.syntax.thrift import definition  # noqa: PLC0415 - loaded on first use

    return definition.parse(source, report)


def parse_bottle(source: Source, report: Report) -> ast_idsl.File:
    """The tree of a Bottle definition."""
    from robocomp_dsl.syntax.bottle import definition  # noqa: PLC0415 - loaded on first use

    return definition.parse(source, report)


def parse_cdsl(source: Source, report: Report) -> ast_cdsl.File:
    """The tree of a component description."""
    from robocomp_dsl.syntax.languages import cdsl  # noqa: PLC0415 - loaded on first use

    return cdsl.parse(source, report)


def parse_pdsl(source: Source, report: Report) -> ast_pdsl.File:
    """The tree of a parameter description."""
    from robocomp_dsl.syntax.languages import pdsl  # noqa: PLC0415 - loaded on first use

    return pdsl.parse(source, report)


def parse_ddsl(source: Source, report: Report) -> ast_ddsl.File:
    """The tree of a deployment description."""
    from robocomp_dsl.syntax.languages import ddsl  # noqa: PLC0415 - loaded on first use

    return ddsl.parse(source, report)


def parse_smdsl(source: Source, report: Report) -> ast_smdsl.File:
    """The tree of a state machine."""
    from robocomp_dsl.syntax.languages import smdsl  # noqa: PLC0415 - loaded on first use

    return smdsl.parse(source, report)


def parse_bdsl(source: Source, report: Report) -> ast_bdsl.File:
    """The tree of a bridge."""
    from robocomp_dsl.syntax.languages import bdsl  # noqa: PLC0415 - loaded on first use

    return bdsl.parse(source, report)


def parse_innermodel(source: Source, report: Report) -> ast_innermodel.File:
    """The tree of an InnerModel file (XML)."""
    from robocomp_dsl.syntax.xml import innermodel  # noqa: PLC0415 - loaded on first use

    return innermodel.parse(source, report)


def parse_scxml(source: Source, report: Report) -> ast_innermodel.File:
    """The tree of a state machine in SCXML."""
    from robocomp_dsl.syntax.xml import innermodel  # noqa: PLC0415 - loaded on first use

    return innermodel.parse_scxml(source, report)


def parse_xml(source: Source, report: Report) -> ast_innermodel.File:
    """The tree of an XML file of another project, including text content."""
    from robocomp_dsl.syntax.xml import innermodel  # noqa: PLC0415 - loaded on first use

    return innermodel.parse_xml(source, report)


LANGUAGES: Mapping[str, Callable[[Source, Report], AnyFile]] = {
    ".idsl": parse_idsl,
    ".cdsl": parse_cdsl,
    ".pdsl": parse_pdsl,
    ".ddsl": parse_ddsl,
    ".smdsl": parse_smdsl,
    ".bdsl": parse_bdsl,
}
"""File suffix (lower case) to parser."""

DEFINITIONS: Mapping[str, Callable[[Source, Report], ast_idsl.File]] = {
    **dict.fromkeys(ROS_SUFFIXES, parse_ros),
    THRIFT_SUFFIX: parse_thrift,
    BOTTLE_SUFFIX: parse_bottle,
}
"""The same for the definitions that IDSL imports as modules: see `syntax/definitions.py`."""
