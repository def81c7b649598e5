"""Checks `set key = value;` of a deployment against the parameters of the component.

In: the settings and the parameters. Out: keys and values, and diagnostics. A path is relative to
the file in which it is written.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.setting_paths import PathSearch
from robocomp_dsl.check.literals import OutOfRange, TypeMismatch, join_names
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.check.pdsl.values import as_kind, check_range, format_number
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model import types
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.syntax.ast.base import Name, Text
from robocomp_dsl.syntax.ast.ddsl import Setting

_STEP = re.compile(r"(?P<name>\w+)(?P<index>(?:\[\s*\d+\s*\])*)")


class _Unknown(Exception):
    """A key names no parameter; the message says why, `guess` is a suggestion."""

    def __init__(self, message: str, guess: str | None = None, way_out: str = "") -> None:
        super().__init__(message)
        self.guess = guess
        self.way_out = way_out


def settings_of(
    written: Sequence[Setting], component: Component, search: PathSearch, report: Report
) -> tuple[tuple[tuple[str, types.Literal], ...], tuple[Path, ...]]:
    """The valid settings in order of writing, and the files and folders that they name.

    `search` finds their paths.
    """
    first: dict[str, Name] = {}
    settings = []
    paths = []
    for setting in written:
        earlier = first.setdefault(setting.key.text, setting.key)
        if earlier is not setting.key:
            report_duplicate(setting.key, earlier, "setting", report)
            continue
        parameter = _parameter(setting, component, report)
        value = _value(setting, parameter, report) if parameter else None
        if value is None or parameter is None:
            continue
        if parameter.is_path and value:
            path = search.find(str(value), setting, report)
            value = str(path or value)
            paths += [path] if path else []
        settings.append((setting.key.text, value))
    return tuple(settings), tuple(dict.fromkeys(paths))


def _parameter(setting: Setting, component: Component, report: Report) -> Parameter | None:
    try:
        return _find(setting.key.text, component)
    except _Unknown as unknown:
        report.add(
            codes.UNKNOWN_SETTING,
            setting.key.span,
            str(unknown),
            label=f"did you mean `{unknown.guess}`?" if unknown.guess else "",
            fix=replace_fix(setting.key.span, unknown.guess) if unknown.guess else None,
            help=unknown.way_out,
        )
        return None


def _value(setting: Setting, parameter: Parameter, report: Report) -> types.Literal | None:
    try:
        value = _fit(setting, parameter)
        check_range(value, parameter)
    except TypeMismatch as wrong:
        code = codes.SETTING_RANGE if isinstance(wrong, OutOfRange) else codes.SETTING_TYPE
        report.add(
            code,
            setting.value.span,
            f"`{setting.key.text}` cannot be set to this: {wrong}",
            label=wrong.label,
            notes=[Note(parameter.span, f"`{parameter.name}` is declared here")],
        )
        return None
    return value


def _fit(setting: Setting, parameter: Parameter) -> types.Literal:
    """The value as for a default; a string may be written without quotes."""
    written = setting.value
    if parameter.kind is Kind.STRING and isinstance(written, Name):
        written = Text(written.span, written.text)
    return as_kind(written, parameter.kind, parameter.choices)


def _find(key: str, component: Component) -> Parameter:
    """The parameter at a dotted key."""
    if component.parameters is None:
        name = component.path.name
        way_out = f'`{name}` names none: `parameters "{component.path.stem}.pdsl";` adds them'
        raise _Unknown(f"`{component.name}` has no parameters", way_out=way_out)
    members, place = component.parameters.parameters, ""
    found: Parameter | None = None
    for step in key.split("."):
        match = _STEP.fullmatch(step)
        name, index = (match["name"], match["index"]) if match else (step, "")
        if found is not None and found.kind is not Kind.GROUP:
            raise _Unknown(f"`{place}` is no group, so it has no `{name}`")
        found = next((setting for setting in members if setting.name == name), None)
        if found is None:
            raise _unknown_name(key, place, name, component, members)
        place = f"{place}.{name}{index}" if place else f"{name}{index}"
        _check_index(place, index, found)
        members = found.members
    if found is None:  # a key has a step at least
        raise _Unknown(f"`{key}` is not the name of a parameter")
    if found.kind is Kind.GROUP:
        inside = join_names([setting.name for setting in found.members])
        raise _Unknown(f"`{place}` is a group: set one of its members, {inside}")
    return found


def _check_index(place: str, index: str, found: Parameter) -> None:
    if found.kind is not Kind.GROUP or found.single:
        if index:
            raise _Unknown(f"`{place}`: `{found.name}` is not a list", place.removesuffix(index))
        return
    numbers = re.findall(r"\d+", index)
    if len(numbers) != 1:
        raise _Unknown(f"`{place}` is a list of groups: add an index, as in `{found.name}[0]`")
    if found.high is not None and int(numbers[0]) >= found.high:
        most = format_number(found.high)
        raise _Unknown(f"`{place}` is beyond the end: `{found.name}` has at most {most}")


def _unknown_name(
    key: str, place: str, name: str, component: Component, members: Sequence[Parameter]
) -> _Unknown:
    where = f"`{place}`" if place else f"`{component.name}`"
    near = nearest(name, [setting.name for setting in members])
    if near is None:
        known = join_names([setting.name for setting in members])
        return _Unknown(f"{where} has no parameter `{name}`, only {known}")
    steps = key.split(".")
    at = place.count(".") + 1 if place else 0
    steps[at] = steps[at].replace(name, near, 1)
    return _Unknown(f"{where} has no parameter `{name}`", ".".join(steps))
