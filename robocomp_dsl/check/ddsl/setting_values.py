"""The value of `set key = value;`: one value, or the values of a list.

In: a setting and the parameter that its key names. Out: the value, and diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.literals import OutOfRange, TypeMismatch
from robocomp_dsl.check.pdsl.values import as_kind, check_range
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model import types
from robocomp_dsl.model.parameter import Default, Kind, Parameter
from robocomp_dsl.syntax.ast.base import Literal, LiteralList, Name, Text
from robocomp_dsl.syntax.ast.ddsl import Setting


def value_of(setting: Setting, parameter: Parameter, report: Report) -> Default | None:
    """The value; None if it is invalid. `parameter` is a single value if the key has an index."""
    written, key = setting.value, setting.key.text
    if not isinstance(written, LiteralList):
        if parameter.is_list:
            _report_shape(setting, parameter, f"{{{written.span.text}}}", report)
            return None
        return _checked(key, written, parameter, report)
    if not parameter.is_list:
        only = written.items[0].span.text if len(written.items) == 1 else None
        _report_shape(setting, parameter, only, report)
        return None
    values = [
        _checked(f"{key}[{index}]", item, parameter, report)
        for index, item in enumerate(written.items)
    ]
    if not _has_length(setting, written, parameter, report) or None in values:
        return None
    return tuple(value for value in values if value is not None)


def _has_length(
    setting: Setting, written: LiteralList, parameter: Parameter, report: Report
) -> bool:
    size, longest = len(written.items), parameter.longest
    if size >= (parameter.shortest or 0) and (longest is None or size <= longest):
        return True
    found = "1 value" if size == 1 else f"{size} values"
    report.add(
        codes.SETTING_RANGE,
        written.span,
        f"`{setting.key.text}` cannot be set to {found}, it has {parameter.describe_length()}",
        notes=[_declaration(parameter)],
    )
    return False


def _report_shape(setting: Setting, parameter: Parameter, fix: str | None, report: Report) -> None:
    """A single value for a list, or a list for a single value."""
    needs = "a list, in braces" if parameter.is_list else "one value"
    report.add(
        codes.SETTING_TYPE,
        setting.value.span,
        f"`{setting.key.text}` cannot be set to this: it is {needs}",
        notes=[_declaration(parameter)],
        fix=replace_fix(setting.value.span, fix) if fix else None,
    )


def _checked(
    key: str, written: Literal, parameter: Parameter, report: Report
) -> types.Literal | None:
    try:
        value = _fit(written, parameter)
        check_range(value, parameter)
    except TypeMismatch as wrong:
        code = codes.SETTING_RANGE if isinstance(wrong, OutOfRange) else codes.SETTING_TYPE
        report.add(
            code,
            written.span,
            f"`{key}` cannot be set to this: {wrong}",
            label=wrong.label,
            notes=[_declaration(parameter)],
        )
        return None
    return value


def _fit(written: Literal, parameter: Parameter) -> types.Literal:
    """The value as for a default; a string may be written without quotes."""
    if parameter.kind is Kind.STRING and isinstance(written, Name):
        written = Text(written.span, written.text)
    return as_kind(written, parameter.kind, parameter.choices)


def _declaration(parameter: Parameter) -> Note:
    return Note(parameter.span, f"`{parameter.name}` is declared here")
