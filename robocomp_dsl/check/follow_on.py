"""Findings of the checks that only follow from a syntax error of the same file.

In: a parsed file and the report of its checks. Out: the report without them. A finding follows from
a syntax error if it is about text whose meaning is a guess, if it is about a name whose declaration
was skipped or has lost its name, or if it says that something is missing in the whole file.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.diagnostics import Diagnostic, Report, UncertainText
from robocomp_dsl.syntax.follow_on import about_uncertain_text

_NAME = re.compile(r"[A-Za-z_]\w*")
_QUOTED = re.compile(r"`([A-Za-z_]\w*)`")


def discard_follow_on_errors(report: Report, file: Parsed[Any]) -> None:
    """Remove from the report what follows from a syntax error of `file`."""
    uncertain = [found.uncertain for found in file.diagnostics if found.uncertain]
    if uncertain:
        found = [d for d in report if d.span.source is file.source]
        report.discard(about_uncertain_text(found))
        report.discard(_about_lost_text(found, uncertain))


def _about_lost_text(
    diagnostics: Sequence[Diagnostic], uncertain: Sequence[UncertainText]
) -> list[Diagnostic]:
    """The diagnostics about names and statements that may be in text that could not be read."""
    from robocomp_dsl.check.codes import (  # noqa: PLC0415 - after syntax errors only
        deployment,
        devices,
        groups,
        names,
        parameters,
        placement,
        states,
        types,
    )

    unknown = {
        names.UNKNOWN_INTERFACE.id,
        names.INTERFACE_NOT_IMPORTED.id,
        types.UNKNOWN_TYPE.id,
        deployment.UNKNOWN_COMPONENT.id,
        deployment.UNKNOWN_INSTANCE.id,
        deployment.UNKNOWN_PORT.id,
        deployment.UNKNOWN_HOST.id,
        devices.UNKNOWN_DEVICE.id,
        groups.UNKNOWN_DEFINITION.id,
        groups.UNKNOWN_MEMBER.id,
        placement.UNKNOWN_LABEL.id,
        states.UNKNOWN_STATE.id,
        types.NOT_AN_EXCEPTION.id,
        types.NOT_A_TYPE.id,
        devices.DEVICE_ACTION.id,
        groups.ENVIRONMENT_CONFLICT.id,
    }
    omissions = {
        deployment.UNSATISFIED_REQUIREMENT.id,
        deployment.AMBIGUOUS_REQUIREMENT.id,
        deployment.NO_PUBLISHER.id,
        deployment.EMPTY_DEPLOYMENT.id,
        parameters.LIST_DEFAULT_LENGTH.id,
        parameters.DEFAULT_IS_LIST.id,
        placement.UNUSED_HOST.id,
        states.NO_INITIAL_STATE.id,
        states.UNREACHABLE_STATE.id,
    }
    lost = frozenset[str]().union(*(text.names for text in uncertain))
    words = {
        found: _words(found) for found in diagnostics if found.unknown or found.code.id in unknown
    }
    # Each declaration without a name explains one unknown name. Of several, one that resembles a
    # known name is rather misspelled.
    explained = sum(text.declares for text in uncertain)
    distinct = {found.span.text for found in words}
    is_explained = len(distinct) <= explained
    return [
        found
        for found in diagnostics
        if found.code.id in omissions
        or not lost.isdisjoint(words.get(found, ()))
        or (found in words and explained and (is_explained or not found.label))
    ]


def _words(found: Diagnostic) -> list[str]:
    """The names that the finding is about."""
    return [*_NAME.findall(found.span.text), *_QUOTED.findall(found.message)]
