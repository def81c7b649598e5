"""The languages by file suffix: which passes check a file, which parser reads it.

In: a path, a `Workspace` and a `Report`. Out: the model of the file, or None.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.model_file.model_kind import MODEL_SUFFIXES, is_model
from robocomp_dsl.check.passes import (
    check_bdsl,
    check_cdsl,
    check_ddsl,
    check_idsl,
    check_innermodel,
    check_model_file,
    check_pdsl,
    check_state_machine,
    check_tactile,
    parse,
)
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.regular_file import open_regular
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.definitions import DEFINITION_SUFFIXES
from robocomp_dsl.syntax.parse import DEFINITIONS, LANGUAGES, parse_innermodel, parse_scxml

if TYPE_CHECKING:
    from robocomp_dsl.model.bridge import Bridge
    from robocomp_dsl.model.component import Component
    from robocomp_dsl.model.deployment import Deployment
    from robocomp_dsl.model.innermodel import InnerModel
    from robocomp_dsl.model.interface import Module
    from robocomp_dsl.model.parameter import ParameterSet
    from robocomp_dsl.model.statemachine import StateMachine

    Model: TypeAlias = (
        tuple[Module, ...]
        | Component
        | ParameterSet
        | Deployment
        | Bridge
        | StateMachine
        | InnerModel
    )
    Check: TypeAlias = Callable[[Path, Workspace, Report], Model | None]


CHECKS: Mapping[str, Check] = {
    ".idsl": check_idsl,
    **dict.fromkeys(DEFINITION_SUFFIXES, check_idsl),
    ".cdsl": check_cdsl,
    ".pdsl": check_pdsl,
    ".ddsl": check_ddsl,
    ".bdsl": check_bdsl,
    ".smdsl": check_state_machine,
    ".scxml": check_state_machine,
    ".xml": check_innermodel,
}
"""File suffix (lower case) to all passes of its language."""

TACTILE = (".yaml", ".yml")
"""Suffixes of tactile descriptions (YAML)."""

_HEAD = 4096

PARSERS: Mapping[str, Callable[[Source, Report], object]] = {
    **LANGUAGES,
    **DEFINITIONS,
    ".scxml": parse_scxml,
    ".xml": parse_innermodel,
}


def check_file(path: Path, workspace: Workspace, report: Report) -> Model | None:
    """Check a file of any language, by its suffix, and return its model."""
    if _tells_touch(path):
        check_tactile(path, workspace, report)
        return None
    if is_model(path):
        check_model_file(path, workspace, report)
        return None
    check = CHECKS.get(path.suffix.lower())
    if check is None:
        _report_language(path, report)
        return None
    return check(path, workspace, report)


def check_syntax(path: Path, workspace: Workspace, report: Report) -> None:
    """Check the syntax of a file only; imports are not resolved."""
    parser = PARSERS.get(path.suffix.lower())
    if _tells_touch(path):
        check_tactile(path, workspace, report, syntax_only=True)
    elif is_model(path):
        check_model_file(path, workspace, report)
    elif parser is None:
        _report_language(path, report)
    else:
        parse(path, parser, workspace, report)


def _tells_touch(path: Path) -> bool:
    """Whether the file is a tactile description: YAML, or XML of one generic part."""
    if path.suffix.lower() != ".xml":
        return path.suffix.lower() in TACTILE
    try:
        with open_regular(path) as file:
            return b"<Generic_Robot_Part" in file.read(_HEAD)
    except OSError:
        return False


def _report_language(path: Path, report: Report) -> None:
    known = ", ".join(f"`{suffix}`" for suffix in (*CHECKS, TACTILE[0], *MODEL_SUFFIXES))
    report.add(
        codes.UNKNOWN_SUFFIX,
        Source(path, "").file_span,
        f"unknown file suffix: `{path}`",
        help=f"known suffixes: {known}",
    )
